#pragma once

#include <cstdint>

namespace esi {

/// What made a pixel fire.
enum class EventCause : std::uint8_t {
  signal,  ///< log intensity crossed a threshold, with the leak's help where there is one
  shot,    ///< shot noise
  hot,     ///< the pixel is hot
};

/// An event of the simulation, whose times stay below 2^31 us.
struct SensorEvent {
  std::int32_t t_us = 0;
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  bool on = false;
  EventCause cause = EventCause::signal;
};

/// Half-open.
struct TimeStep {
  std::int32_t begin_us = 0;
  std::int32_t end_us = 0;
  std::int32_t duration_us() const { return end_us - begin_us; }
};

}  // namespace esi
