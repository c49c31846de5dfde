#include "esi/core/event.hpp"

#include <fmt/format.h>

#include <charconv>

#include "esi/core/error.hpp"

namespace esi {

SensorSize parse_sensor_size(std::string_view text) {
  SensorSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width_px);
  const bool has_cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(has_cross ? width.ptr + 1 : end, end, size.height_px);
  if (!has_cross || height.ec != std::errc{} || height.ptr != end) {
    throw usage_error(fmt::format("sensor size '{}': write WIDTHxHEIGHT, such as 346x260", text));
  }
  const auto sane = [](int side) { return side >= 1 && side <= kMaxSensorSide_px; };
  if (!sane(size.width_px) || !sane(size.height_px)) {
    throw usage_error(fmt::format("sensor size '{}': each side must be 1 to {} px", text, kMaxSensorSide_px));
  }
  return size;
}

std::string to_string(SensorSize size) { return fmt::format("{}x{}", size.width_px, size.height_px); }

}  // namespace esi
