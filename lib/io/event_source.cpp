#include "esi/io/event_source.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/event_gate.hpp"

namespace esi {

std::unique_ptr<EventSource> open_recording(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path == "-" ? "standard input" : path.string();
  return std::make_unique<EventGate>(open_reader(path, options), options, name);
}

SensorSize require_sensor_size(const EventSource& source, const std::string& name) {
  if (const auto size = source.sensor_size()) return *size;
  throw usage_error(
      fmt::format("{}: the file ({}) does not say how large the sensor is; give --size WIDTHxHEIGHT, such "
                  "as --size 346x260 (esi-recon --info shows the largest x and y)",
                  name, source.header().layout));
}

}  // namespace esi
