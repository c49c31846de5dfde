#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace esi {

/// One brightness change at one pixel: log intensity moved by one contrast threshold since the pixel's last
/// event. Origin top left, y down.
struct Event {
  std::int64_t t_us;
  std::uint16_t x;
  std::uint16_t y;
  bool on;  ///< polarity: true is ON (brighter)

  friend bool operator==(const Event&, const Event&) = default;
};
static_assert(sizeof(Event) == 16);

struct SensorSize {
  int width_px = 0;
  int height_px = 0;

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
  friend bool operator==(const SensorSize&, const SensorSize&) = default;
};

/// Coordinates are 16 bits wide, so no side of a sensor is longer.
inline constexpr int kMaxSensorSide_px = 65536;

/// Reads "346x260". Throws a usage Error that shows the right form.
SensorSize parse_sensor_size(std::string_view text);

/// "346x260"
std::string to_string(SensorSize size);

}  // namespace esi
