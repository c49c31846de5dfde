#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace esi {

/// What makes one cell better than another: the rate that decides; of equal ones fewer false detections, then
/// the smaller corner error, then to come first in the grid.
struct CellMerit {
  std::optional<double> rate;
  std::int64_t wrong = 0;
  std::optional<double> corner_error_px;
  std::size_t cell = 0;
};

inline bool is_better(const CellMerit& a, const CellMerit& b) {
  const double rate_a = a.rate.value_or(-1.0), rate_b = b.rate.value_or(-1.0);
  if (rate_a != rate_b) return rate_a > rate_b;
  if (a.wrong != b.wrong) return a.wrong < b.wrong;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const double error_a = a.corner_error_px.value_or(unknown), error_b = b.corner_error_px.value_or(unknown);
  return error_a != error_b ? error_a < error_b : a.cell < b.cell;
}

}  // namespace esi
