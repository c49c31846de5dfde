#pragma once

#include <cmath>
#include <cstdint>

#include "esi/recon/decay_loss.hpp"

namespace esi {

/// 1 - exp(-rate dt) for any dt >= 0: from a table for the times that occur between a pixel's events, with
/// its errors (below 8e-6, and below 1e-4 of the loss itself); from the formula for half an hour and more.
class ExponentialLoss {
 public:
  explicit ExponentialLoss(double rate_hz)
      : table_({.decay = Decay::exponential, .alpha_hz = rate_hz}), rate_per_us_(rate_hz * 1e-6) {}

  double operator()(std::int64_t dt_us) const {
    if (dt_us < kTableEnd_us) return static_cast<double>(table_(static_cast<std::int32_t>(dt_us)));
    return -std::expm1(-rate_per_us_ * static_cast<double>(dt_us));
  }

 private:
  static constexpr std::int64_t kTableEnd_us = (std::int64_t{1} << 31) - 2;

  TableLoss table_;
  double rate_per_us_;
};

}  // namespace esi
