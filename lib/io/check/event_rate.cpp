#include "esi/io/check/event_rate.hpp"

namespace esi {

void EventRate::add(std::span<const Event> events) {
  if (bins_.empty() && !events.empty()) begin_us_ = events.front().t_us;
  for (const Event& event : events) {
    while ((event.t_us - begin_us_) / bin_us_ >= static_cast<std::int64_t>(kMaxBins)) widen();
    const auto bin = static_cast<std::size_t>((event.t_us - begin_us_) / bin_us_);
    if (bin >= bins_.size()) bins_.resize(bin + 1);
    ++bins_[bin];
  }
}

void EventRate::widen() {
  bin_us_ *= 2;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (i % 2 == 0) {
      bins_[i / 2] = bins_[i];
    } else {
      bins_[i / 2] += bins_[i];
    }
  }
  bins_.resize((bins_.size() + 1) / 2);
}

}  // namespace esi
