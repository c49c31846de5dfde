#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "esi/sim/random.hpp"
#include "esi/sim/sensor_event.hpp"
#include "esi/sim/sensor_options.hpp"

namespace esi {

/// The noise events of one pixel: a Poisson process in continuous time, so that its statistics know nothing
/// of simulation steps. Candidates come at the highest rate; each becomes an event with the probability that
/// the light asks for (thinning, Lewis & Shedler 1979). Each draw is keyed by its pixel and the candidate's
/// time.
class NoiseSource {
 public:
  static constexpr std::int32_t kNever_us = std::numeric_limits<std::int32_t>::max();

  struct Event {
    bool on = false;
    EventCause cause = EventCause::shot;
  };

  /// `place` tells pixels apart; `hot_hz` is 0 for most.
  NoiseSource(const SensorOptions& options, std::int64_t seed, std::uint64_t place, double hot_hz)
      : options_(&options),
        random_(seed, RandomStream::noise, place),
        hot_hz_(hot_hz),
        rate_hz_(options.shot_hz + hot_hz) {}

  /// The first candidate after t_us.
  std::int32_t next_us(std::int32_t t_us) const;

  /// What the candidate at t_us becomes in this light (relative intensity).
  std::optional<Event> draw(std::int32_t t_us, double light) const;

 private:
  // Each candidate takes three numbers.
  static std::uint64_t number(std::int32_t t_us, std::uint64_t i) {
    return 4 * static_cast<std::uint64_t>(static_cast<std::uint32_t>(t_us)) + i;
  }

  const SensorOptions* options_;
  RandomKey random_;
  double hot_hz_;
  double rate_hz_;
};

}  // namespace esi
