#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/phase.hpp"
#include "esi/sim/sensor_event.hpp"

namespace esi {

/// Counts a simulation's events by phase, polarity and cause.
class PhaseCounts {
 public:
  explicit PhaseCounts(const std::vector<Phase>& phases);

  /// Events in order of time, each with its cause.
  void add(std::span<const Event> events, std::span<const EventCause> causes);

  /// A list with name, start_s, end_s, events, on, signal, shot, hot and rate_mev_s of each phase.
  nlohmann::json json() const;

 private:
  struct Count {
    Phase phase;
    std::int64_t on = 0;
    std::int64_t by_cause[3] = {};
  };
  std::vector<Count> counts_;
};

}  // namespace esi
