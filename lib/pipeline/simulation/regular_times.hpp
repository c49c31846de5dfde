#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace esi {

/// The times 0, 1/rate, 2/rate, ..., made from their numbers so that none drifts.
class RegularTimes {
 public:
  explicit RegularTimes(double rate_hz) : rate_hz_(rate_hz) {}

  /// The next one, unless it comes after `last_us`.
  std::optional<std::int64_t> next(std::int64_t last_us) {
    const auto t_us = std::llround(static_cast<double>(count_) * 1e6 / rate_hz_);
    if (t_us > last_us) return std::nullopt;
    ++count_;
    return t_us;
  }

 private:
  double rate_hz_;
  std::int64_t count_ = 0;
};

}  // namespace esi
