#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "esi/recon/decay.hpp"

// gamma as the event loop wants it: no branches, few instructions. Both forms give the *loss* 1 - gamma, with
// a small relative error, so that E - E * loss doesn't drift at pixels with many short gaps. (A float that
// holds gamma itself can't tell 1 - 1e-8 from 1.) They take times 0 <= dt_us < 2^31 - 1, give exactly 0 at 0,
// and exactly 1 from the end of the support on.

namespace esi {

/// Closed form for alpha = 0 and n = 1, 2 or 3, and for `none`: a cubic in u = dt / tau.
class CubicLoss {
 public:
  /// Nothing where the decay isn't of that kind.
  static std::optional<CubicLoss> of(const DecayOptions& options);

  float operator()(std::int32_t dt_us) const {
    const float u = std::min(static_cast<float>(dt_us) * per_us_, 1.0F);
    return u * (k1_ + u * (k2_ + u * k3_));
  }

 private:
  float per_us_ = 0.0F;  ///< 1 / tau
  float k1_ = 0.0F;
  float k2_ = 0.0F;
  float k3_ = 0.0F;
};

/// Any decay: straight lines in 1024 cells an octave of dt, found by the bits of a float. The cells widen
/// with dt, so they follow a dt^n at microseconds as well as at seconds: the error stays below 8e-6, and
/// below 1e-4 of the loss itself. (For `polynomial` with 1 < n < 2, below 2e-5 in the last 1/100 of the
/// support.)
class TableLoss {
 public:
  explicit TableLoss(const DecayOptions& options);

  float operator()(std::int32_t dt_us) const {
    const float x = std::min(static_cast<float>(dt_us + 1), end_);
    const Cell& cell = cells_[std::size_t{std::bit_cast<std::uint32_t>(x) >> kCellBits} - kFirst];
    return cell.a + x * cell.b;
  }

 private:
  struct Cell {
    float a = 0.0F;
    float b = 0.0F;
  };
  static constexpr int kCellBits = 23 - 10;  ///< mantissa bits of x = dt + 1 inside a cell
  static constexpr std::size_t kFirst = std::bit_cast<std::uint32_t>(1.0F) >> kCellBits;

  static float left_edge(std::size_t i);
  static Cell line(const DecayOptions& options, double left, double right);

  float end_;  ///< x from which the loss is constant
  std::vector<Cell> cells_;
};

using DecayLoss = std::variant<CubicLoss, TableLoss>;

/// The fastest form for a decay.
DecayLoss loss_of(const DecayOptions& options);

}  // namespace esi
