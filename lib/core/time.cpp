#include "esi/core/time.hpp"

#include <fmt/format.h>

#include <cmath>

#include "esi/core/error.hpp"

namespace esi {

std::int64_t us_from_seconds(double seconds) {
  const double t_us = std::floor(seconds * 1e6 + 0.5);
  if (!(std::abs(t_us) < 9.2e18)) throw usage_error(fmt::format("time {} s is out of range", seconds));
  return static_cast<std::int64_t>(t_us);
}

std::string seconds_text(std::int64_t t_us) {
  const bool negative = t_us < 0;
  const auto magnitude = negative ? 0 - static_cast<std::uint64_t>(t_us) : static_cast<std::uint64_t>(t_us);
  return fmt::format("{}{}.{:06}000", negative ? "-" : "", magnitude / 1000000, magnitude % 1000000);
}

}  // namespace esi
