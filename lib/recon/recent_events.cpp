#include "esi/recon/recent_events.hpp"

#include <algorithm>

namespace esi {

void RecentEvents::add(std::span<const Event> events, std::span<const float> weights) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    const float weight = weights.empty() ? 1.0F : weights[i];
    events_.push_back({event.t_us, event.x, event.y, event.on ? weight : -weight});
  }
  drop_old();
}

// Moves what is left to the front only when at least as much goes: O(1) per event in the long run.
void RecentEvents::drop_old() {
  if (events_.empty()) return;
  const std::int64_t t_last_us = events_.back().t_us;
  while (t_last_us - events_[first_].t_us > span_us_) ++first_;
  if (first_ < events_.size() - first_) return;
  events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(first_));
  first_ = 0;
}

std::span<const SignedEvent> RecentEvents::within(Interval interval) const {
  const auto kept = all();
  const auto first_from = [&kept](std::int64_t t_us) {
    const auto is_before = [t_us](const SignedEvent& event) { return event.t_us < t_us; };
    return static_cast<std::size_t>(std::partition_point(kept.begin(), kept.end(), is_before) - kept.begin());
  };
  const std::size_t begin = first_from(interval.begin_us);
  return kept.subspan(begin, first_from(interval.end_us) - begin);
}

}  // namespace esi
