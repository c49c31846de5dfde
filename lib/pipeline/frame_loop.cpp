#include "esi/pipeline/frame_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {

FrameLoop::FrameLoop(FrameSchedule& schedule, Reconstructor& method, FrameSink& sink, std::int64_t max_frames,
                     const std::string& name)
    : schedule_(schedule), method_(method), sink_(sink), max_frames_(max_frames), name_(name) {}

void FrameLoop::take(const Packet& packet) {
  schedule_.add_packet_ends(packet.packet_ends_us);
  for (const IntensityFrame& frame : packet.frames) {
    schedule_.add_exposure_end(frame.exposure.end_us);
    unobserved_.push_back(frame);
  }
  if (packet.events.empty()) return;
  t_last_us_ = packet.events.back().t_us;
  refuse_flood(*t_last_us_);
  std::span<const Event> events = packet.events;
  while (const auto cut = schedule_.next(events)) {
    process(events.first(cut->events), cut->t_us);
    render(cut->t_us);
    events = events.subspan(cut->events);
  }
  process(events, *t_last_us_);  // a frame that is still to be cut is due after the last event
}

void FrameLoop::finish(std::optional<std::int64_t> cut_at_us) {
  const auto t_last_us = cut_at_us && t_last_us_ ? *cut_at_us - 1 : t_last_us_;
  while (const auto cut = schedule_.last(t_last_us)) {
    process({}, cut->t_us);
    render(cut->t_us);
  }
}

/// Takes events, with the intensity frames whose exposures end by t_end_us in their places among them.
void FrameLoop::process(std::span<const Event> events, std::int64_t t_end_us) {
  for (; !unobserved_.empty() && unobserved_.front().exposure.end_us <= t_end_us; unobserved_.pop_front()) {
    const std::int64_t t_us = unobserved_.front().exposure.end_us;
    const auto first_later = std::partition_point(events.begin(), events.end(),
                                                  [t_us](const Event& event) { return event.t_us < t_us; });
    const auto earlier = static_cast<std::size_t>(first_later - events.begin());
    feed(events.first(earlier));
    method_.observe(unobserved_.front());
    ++intensity_frames_;
    events = events.subspan(earlier);
  }
  feed(events);
}

void FrameLoop::feed(std::span<const Event> events) {
  method_.process(events);
  events_since_frame_ += static_cast<std::int64_t>(events.size());
}

void FrameLoop::render(std::int64_t t_us) {
  method_.render(t_us, frame_.grey);
  frame_.index = frames_++;
  frame_.t_us = t_us;
  frame_.events_since_previous = std::exchange(events_since_frame_, 0);
  sink_.write(frame_);
}

void FrameLoop::refuse_flood(std::int64_t t_us) const {
  const std::int64_t due = schedule_.frames_before(t_us);
  if (due < max_frames_) return;
  throw Error(
      fmt::format("{}: {} frames would be due by the event at {} s, more than --max-frames {}; the recording "
                  "has a gap or starts late: use --start, a lower --fps, or --time-zero first-event",
                  name_, due, seconds_text(t_us), max_frames_));
}

}  // namespace esi
