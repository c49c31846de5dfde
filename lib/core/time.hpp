#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace esi {

/// Half-open span of time [begin, end).
struct Interval {
  std::int64_t begin_us = std::numeric_limits<std::int64_t>::min();
  std::int64_t end_us = std::numeric_limits<std::int64_t>::max();

  bool contains(std::int64_t t_us) const { return t_us >= begin_us && t_us < end_us; }
  bool is_empty() const { return end_us <= begin_us; }
  std::int64_t duration_us() const { return end_us - begin_us; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Seconds to whole microseconds, rounded half up. Throws a usage Error outside +-292 thousand years.
std::int64_t us_from_seconds(double seconds);

/// The time in seconds with nine decimals, exactly: "-0.000001000". The form of timestamps.txt.
std::string seconds_text(std::int64_t t_us);

}  // namespace esi
