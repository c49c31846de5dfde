#pragma once

#include <functional>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/padded_plane.hpp"

namespace esi {

/// An energy, or a residual's product with itself, below which there is nothing left to improve.
constexpr double kNothing = 1e-30;

/// Of sums side by side, which are vectorised without reordering.
inline double sum_of(const float (&sums)[kVectorFloats]) {
  double sum = 0.0;
  for (const float value : sums) sum += static_cast<double>(value);
  return sum;
}

/// Of `count` entries, always added in the same order.
double sum(const float* a, int count);

/// a . b over `count` entries, always added in the same order.
double dot(const float* a, const float* b, int count);

/// of_row(y) of an image's rows, whoever took them, always added in the same order.
double sum_over_rows(const RowTeam& team, cv::Size image, const std::function<double(int y)>& of_row);

}  // namespace esi
