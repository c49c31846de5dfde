#include "esi/pipeline/simulation/phase_counts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace esi {

PhaseCounts::PhaseCounts(const std::vector<Phase>& phases) {
  for (const Phase& phase : phases) counts_.push_back({phase});
}

void PhaseCounts::add(std::span<const Event> events, std::span<const EventCause> causes) {
  const auto begins_before = [&](std::int64_t t_us) {
    const auto first = std::partition_point(events.begin(), events.end(),
                                            [t_us](const Event& event) { return event.t_us < t_us; });
    return static_cast<std::size_t>(first - events.begin());
  };
  for (Count& count : counts_) {
    const std::size_t end = begins_before(count.phase.interval.end_us);
    for (std::size_t i = begins_before(count.phase.interval.begin_us); i < end; ++i) {
      count.on += events[i].on ? 1 : 0;
      ++count.by_cause[static_cast<std::size_t>(causes[i])];
    }
  }
}

nlohmann::json PhaseCounts::json() const {
  nlohmann::json list = nlohmann::json::array();
  for (const Count& count : counts_) {
    const auto& [signal, shot, hot] = count.by_cause;
    const Interval& interval = count.phase.interval;
    const std::int64_t events = signal + shot + hot;
    list.push_back(
        {{"name", count.phase.name},
         {"start_s", static_cast<double>(interval.begin_us) * 1e-6},
         {"end_s", static_cast<double>(interval.end_us) * 1e-6},
         {"events", events},
         {"on", count.on},
         {"signal", signal},
         {"shot", shot},
         {"hot", hot},
         // Events per microsecond are million events per second.
         {"rate_mev_s", static_cast<double>(events) / static_cast<double>(interval.duration_us())}});
  }
  return list;
}

}  // namespace esi
