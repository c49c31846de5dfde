#include "esi/recon/event_windows.hpp"

#include <algorithm>

namespace esi {

void EventWindows::add(std::span<const Event> events, std::span<const float> weights, const Take& take) {
  while (!events.empty()) {
    if (duration_us_ > 0) end_by(events.front().t_us, take);
    const std::size_t taken = fitting(events);
    events_.insert(events_.end(), events.begin(), events.begin() + static_cast<std::ptrdiff_t>(taken));
    if (weights.empty()) {
      weights_.resize(events_.size(), 1.0F);
    } else {
      weights_.insert(weights_.end(), weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(taken));
      weights = weights.subspan(taken);
    }
    events = events.subspan(taken);
    if (events_.size() == count_) hand_on(take);
  }
}

void EventWindows::end_by(std::int64_t t_us, const Take& take) {
  if (duration_us_ == 0 || events_.empty()) return;
  if (index_of(t_us) > index_of(events_.front().t_us)) hand_on(take);
}

std::size_t EventWindows::fitting(std::span<const Event> events) const {
  if (duration_us_ == 0) return std::min(events.size(), count_ - events_.size());
  const std::int64_t open = index_of(events_.empty() ? events.front().t_us : events_.front().t_us);
  const auto fits = [&](const Event& event) { return index_of(event.t_us) <= open; };
  return static_cast<std::size_t>(std::partition_point(events.begin(), events.end(), fits) - events.begin());
}

std::int64_t EventWindows::index_of(std::int64_t t_us) const {
  return t_us / duration_us_ - (t_us % duration_us_ < 0 ? 1 : 0);
}

void EventWindows::hand_on(const Take& take) {
  take(events_, weights_);
  events_.clear();
  weights_.clear();
}

}  // namespace esi
