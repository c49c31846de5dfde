#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// Writes events as one layout of one format, byte by byte, for a sensor of 240x180 px.
struct Encoder {
  std::string_view format;      ///< the row of the formats table, or "zip"
  std::string_view layout;      ///< a file name's worth: "mvsec.hdf5"
  bool has_sensor_size = true;  ///< whether the file says how large the sensor is
  std::string (*encode)(std::span<const Event> events);
};

/// At least one for each format.
std::span<const Encoder> encoders();

/// Events that any layout can hold: an edge that moves over the sensor, one event each 50 us from 0 on.
std::vector<Event> moving_edge(std::int64_t count);

}  // namespace esi::test
