#include "esi/io/event_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;
// Times beyond this (36 thousand years) are garbage; within it, no difference of two times overflows.
constexpr std::int64_t kMaxTime_us = std::int64_t{1} << 60;
// So many events within one jitter window are released all the same: memory stays bounded.
constexpr std::size_t kMaxHeldEvents = std::size_t{1} << 17;
// So many events behind a jump ahead decide whether time went on from there, or back to where it was.
constexpr std::ptrdiff_t kJurors = 256;
// So many intensity frames may come before the first event.
constexpr std::size_t kMaxHeldFrames = 64;

std::int64_t possible(std::int64_t t_us) { return std::clamp(t_us, -kMaxTime_us, kMaxTime_us); }

bool is_earlier(const Event& a, const Event& b) { return a.t_us < b.t_us; }

bool ends_earlier(const IntensityFrame& a, const IntensityFrame& b) {
  return a.exposure.end_us < b.exposure.end_us;
}

}  // namespace

EventGate::EventGate(std::unique_ptr<FormatReader> reader, const ReadOptions& options, std::string name)
    : reader_(std::move(reader)), options_(options), name_(std::move(name)), size_(options.sensor_size()) {
  if (!size_) size_ = reader_->header().sensor;
}

bool EventGate::next(Packet& packet) {
  packet.clear();
  while (!at_end_ && packet.events.empty() && packet.frames.empty()) {
    const std::size_t first_event = held_.events.size();
    const std::size_t first_frame = held_.frames.size();
    const std::size_t first_packet_end = held_.packet_ends_us.size();
    at_end_ = !reader_->read(held_, losses_);
    const bool has_new = held_.events.size() > first_event;
    if (has_new && is_jump(held_.events.back())) at_end_ = !reader_->read(held_, losses_);  // to judge it
    if (!time_zero_us_ && held_.frames.size() > kMaxHeldFrames) {
      settle_time_zero(possible(held_.frames.front().exposure.begin_us));
    }
    admit(first_event);
    if (time_zero_us_) shift_new(first_frame, first_packet_end);
    if (at_end_ || options_.strict) check_losses();
    release(packet);
  }
  return !packet.events.empty() || !packet.frames.empty();
}

void EventGate::admit(std::size_t first_new) {
  auto kept = held_.events.begin() + static_cast<std::ptrdiff_t>(first_new);
  bool sorted = true;
  for (auto event = kept; event != held_.events.end(); ++event) {
    admit_plain(event, kept);
    if (event == held_.events.end()) break;
    if (!is_inside(*event)) {
      losses_.add(Drop::outside_sensor);
      continue;
    }
    if (is_stray(event)) {
      losses_.add(Drop::time_jump);
      continue;
    }
    require_possible(event->t_us);
    if (!time_zero_us_) settle_time_zero(event->t_us);
    const std::int64_t t_us = event->t_us - *time_zero_us_;
    const Order order = order_of(t_us);
    if (order == Order::backward) {
      losses_.add(Drop::backward_time);
      continue;
    }
    if (order == Order::jitter) {
      losses_.add(Damage::sorted_jitter);
      sorted = false;
    }
    *kept++ = {t_us, event->x, event->y, event->on};
    ++admitted_;
  }
  held_.events.erase(kept, held_.events.end());
  if (!sorted) std::stable_sort(held_.events.begin(), held_.events.end(), is_earlier);
}

// Those about which nothing is to be decided, which most are: inside, and not long after the event before.
void EventGate::admit_plain(std::vector<Event>::iterator& event, std::vector<Event>::iterator& kept) {
  if (!size_ || !newest_us_) return;
  const SensorSize size = *size_;
  const std::int64_t zero_us = *time_zero_us_;
  const auto limit_us = static_cast<std::uint64_t>(options_.max_backward_us);
  std::int64_t newest_us = *newest_us_ + zero_us;
  int max_x = max_x_seen_, max_y = max_y_seen_;
  const auto begin = kept;
  const auto is_plain = [&](const Event& e) {  // unsigned: what lies before is far ahead
    const auto ahead_us = static_cast<std::uint64_t>(e.t_us) - static_cast<std::uint64_t>(newest_us);
    return ahead_us <= limit_us && e.t_us <= kMaxTime_us && size.contains(e.x, e.y);
  };
  for (; event != held_.events.end() && is_plain(*event); ++event) {
    newest_us = event->t_us;
    max_x = std::max<int>(max_x, event->x);
    max_y = std::max<int>(max_y, event->y);
    *kept++ = {newest_us - zero_us, event->x, event->y, event->on};
  }
  newest_us_ = newest_us - zero_us;
  max_x_seen_ = max_x;
  max_y_seen_ = max_y;
  admitted_ += std::distance(begin, kept);
}

bool EventGate::is_inside(const Event& event) {
  max_x_seen_ = std::max<int>(max_x_seen_, event.x);
  max_y_seen_ = std::max<int>(max_y_seen_, event.y);
  return !size_ || size_->contains(event.x, event.y);
}

// Ahead of all events so far.
bool EventGate::is_jump(const Event& event) const {
  return !newest_us_ || possible(event.t_us) - *time_zero_us_ - *newest_us_ > options_.max_backward_us;
}

// An event far ahead of those before it, while most of those after it go back, has a damaged time. Were it
// believed, all of those would count as backward.
bool EventGate::is_stray(std::vector<Event>::const_iterator event) const {
  if (!is_jump(*event)) return false;
  const auto begin = std::next(event);
  const auto end = begin + std::min(kJurors, std::distance(begin, held_.events.cend()));
  const auto back = std::count_if(begin, end, [&](const Event& later) {
    return possible(event->t_us) - possible(later.t_us) > options_.max_backward_us;
  });
  return 2 * back > std::distance(begin, end);
}

EventGate::Order EventGate::order_of(std::int64_t t_us) {
  if (!newest_us_ || t_us >= *newest_us_) {
    newest_us_ = t_us;
    return Order::in_order;
  }
  const std::int64_t back_us = *newest_us_ - t_us;
  if (back_us > options_.max_backward_us) {
    throw Error(fmt::format(
        "{}: time goes back by {} us after event {} (at {} us); sort the recording by time, or raise "
        "--max-backward-us to leave such events out",
        name_, back_us, admitted_, *newest_us_ + *time_zero_us_));
  }
  const bool too_late = newest_released_us_ && t_us < *newest_released_us_;
  return back_us > options_.jitter_us || too_late ? Order::backward : Order::jitter;
}

void EventGate::require_possible(std::int64_t t_us) const {
  if (t_us == possible(t_us)) return;
  throw Error(fmt::format("{}: an event's time, {} us, can't be right; check the format and the time unit",
                          name_, t_us));
}

void EventGate::settle_time_zero(std::int64_t t_first_us) {
  const bool near_zero = t_first_us > -kHour_us && t_first_us < kHour_us;
  const bool from_file =
      options_.time_zero == TimeZero::file || (options_.time_zero == TimeZero::automatic && near_zero);
  time_zero_us_ = from_file ? 0 : t_first_us;
}

// Frames that came before the clock's zero was known are among the new ones as long as none was shifted.
void EventGate::shift_new(std::size_t first_frame, std::size_t first_packet_end) {
  if (unshifted_) {
    first_frame = 0;
    first_packet_end = 0;
    unshifted_ = false;
  }
  for (std::size_t i = first_frame; i < held_.frames.size(); ++i) {
    Interval& exposure = held_.frames[i].exposure;
    exposure = {possible(exposure.begin_us) - *time_zero_us_, possible(exposure.end_us) - *time_zero_us_};
  }
  for (std::size_t i = first_packet_end; i < held_.packet_ends_us.size(); ++i) {
    held_.packet_ends_us[i] = possible(held_.packet_ends_us[i]) - *time_zero_us_;
  }
  std::stable_sort(held_.frames.begin(), held_.frames.end(), ends_earlier);
}

// Later events may be up to one jitter window older than the newest; what is older than that is settled.
void EventGate::release(Packet& packet) {
  if (!newest_us_ && !at_end_ && held_.frames.size() <= kMaxHeldFrames) return;
  const bool all = at_end_ || held_.events.size() > kMaxHeldEvents || !newest_us_;
  const std::int64_t settled_us = all ? INT64_MAX : *newest_us_ - options_.jitter_us;

  std::swap(packet.events, held_.events);
  const auto unsettled = std::partition_point(packet.events.begin(), packet.events.end(),
                                              [&](const Event& event) { return event.t_us <= settled_us; });
  held_.events.assign(unsettled, packet.events.end());
  packet.events.erase(unsettled, packet.events.end());
  if (!packet.events.empty()) newest_released_us_ = packet.events.back().t_us;

  const auto frames_end =
      std::partition_point(held_.frames.begin(), held_.frames.end(),
                           [&](const IntensityFrame& frame) { return frame.exposure.end_us <= settled_us; });
  packet.frames.assign(std::make_move_iterator(held_.frames.begin()), std::make_move_iterator(frames_end));
  held_.frames.erase(held_.frames.begin(), frames_end);
  packet.packet_ends_us.insert(packet.packet_ends_us.end(), held_.packet_ends_us.begin(),
                               held_.packet_ends_us.end());
  held_.packet_ends_us.clear();
}

void EventGate::check_losses() const {
  const std::int64_t outside = losses_.of(Drop::outside_sensor);
  const auto in_order_of_file = static_cast<double>(outside + admitted_);
  if (at_end_ && static_cast<double>(outside) > options_.max_outside * in_order_of_file) {
    throw Error(fmt::format(
        "{}: {} of {} events lie outside the sensor{}; the largest x is {}, the largest y {}; give the right "
        "--size, or allow more with --max-outside",
        name_, outside, outside + admitted_, size_ ? " of " + to_string(*size_) : "", max_x_seen_,
        max_y_seen_));
  }
  if (options_.strict && losses_.any()) {
    throw Error(
        fmt::format("{}: the input is damaged ({}), and --strict allows no loss", name_, losses_.text()));
  }
}

}  // namespace esi
