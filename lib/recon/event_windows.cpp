#include "esi/recon/event_windows.hpp"

#include <algorithm>
#include <limits>

namespace esi {
namespace {

/// The latest time there is, where the sum would be beyond it.
std::int64_t later(std::int64_t t_us, std::int64_t duration_us) {
  constexpr std::int64_t kLatest_us = std::numeric_limits<std::int64_t>::max();
  return t_us > kLatest_us - duration_us ? kLatest_us : t_us + duration_us;
}

/// k D of the [k D, (k + 1) D) that t_us lies in, or the earliest time there is.
std::int64_t clock_before(std::int64_t t_us, std::int64_t duration_us) {
  const std::int64_t rest_us = t_us % duration_us;
  const std::int64_t passed_us = rest_us < 0 ? rest_us + duration_us : rest_us;
  constexpr std::int64_t kEarliest_us = std::numeric_limits<std::int64_t>::min();
  return t_us < kEarliest_us + passed_us ? kEarliest_us : t_us - passed_us;
}

}  // namespace

void EventWindows::add(std::span<const Event> events, std::span<const float> weights, const Take& take) {
  while (!events.empty()) {
    end_by(events.front().t_us, take);
    if (events_.empty() && kind_ != Kind::count) {
      const std::int64_t begin_us = begin_of_window_with(events.front().t_us);
      open_ = {begin_us, later(begin_us, duration_us_)};
    }
    const std::size_t taken = fitting(events);
    events_.insert(events_.end(), events.begin(), events.begin() + static_cast<std::ptrdiff_t>(taken));
    if (weights.empty()) {
      weights_.resize(events_.size(), 1.0F);
    } else {
      weights_.insert(weights_.end(), weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(taken));
      weights = weights.subspan(taken);
    }
    events = events.subspan(taken);
    if (events_.size() == count_) end_at_count(take);
  }
}

std::int64_t EventWindows::begin_of_window_with(std::int64_t t_us) const {
  if (kind_ == Kind::time) return clock_before(t_us, duration_us_);
  const bool continues = last_ && t_us < later(last_->end_us, duration_us_);
  return continues ? last_->end_us : t_us;
}

std::size_t EventWindows::fitting(std::span<const Event> events) const {
  const std::size_t room = events_.size() < count_ ? count_ - events_.size() : events.size();
  if (kind_ == Kind::count) return std::min(events.size(), room);
  const auto fits = [&](const Event& event) { return event.t_us < open_.end_us; };
  const auto end = std::partition_point(events.begin(), events.end(), fits);
  // The first does: the window was opened for it, or it would have ended.
  return std::clamp<std::size_t>(static_cast<std::size_t>(end - events.begin()), 1, room);
}

void EventWindows::end_at_count(const Take& take) {
  if (kind_ == Kind::count) return hand_on(take);
  const std::int64_t end_us =
      std::max(later(events_.back().t_us, 1), later(open_.begin_us, kShortestWindow_us));
  open_.end_us = std::min(open_.end_us, end_us);
}

void EventWindows::end_by(std::int64_t t_us, const Take& take) {
  if (kind_ == Kind::count || events_.empty()) return;
  if (t_us >= open_.end_us) hand_on(take);
}

std::optional<std::int64_t> EventWindows::open_begin_us() const {
  if (kind_ == Kind::count || events_.empty()) return std::nullopt;
  return open_.begin_us;
}

void EventWindows::hand_on(const Take& take) {
  if (kind_ != Kind::count) last_ = open_;
  take(events_, weights_);
  events_.clear();
  weights_.clear();
}

}  // namespace esi
