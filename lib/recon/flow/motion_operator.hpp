#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/core/row_team.hpp"

namespace esi {

/// The symmetric, positive definite operator of the least-squares problem, on one grid of pixels:
///   M L = -div (A grad L) - eps (5-point Laplacian of L) + mu L                                  (6)
/// grad L is of the 2x2 pixels around a corner between pixels. With D and E the differences along its two
/// diagonals (lower right minus upper left, upper right minus lower left),
///   grad L = ((D + E) / 2, (D - E) / 2),   grad L^T A grad L = dd D^2 + 2 de D E + ee E^2        (7)
/// A corner has the index of its upper left pixel; the last row and column of corners hold 0.
class MotionOperator {
 public:
  explicit MotionOperator(cv::Size size);

  cv::Size size() const { return dd.size(); }

  /// out = M in; returns in . M in. `in` and `out` are of this size, and not the same.
  double apply(const cv::Mat1f& in, cv::Mat1f& out) const;

  /// Row y of M in, which depends on the rows y - 1 to y + 1 of `in`.
  void apply_row(const cv::Mat1f& in, int y, float* out) const;

  /// Row y of 1 / the diagonal of M.
  void inverse_diagonal_row(int y, float* out) const;

  /// The same problem on half the resolution. In two dimensions the energy of a gradient doesn't depend on
  /// the pixels' size, that of mu does. `coarse` has half this size, rounded up.
  void coarsen(MotionOperator& coarse, const RowTeam& team = kAlone) const;

  cv::Mat1f dd, de, ee;
  float eps = 0.0F;
  float mu = 0.0F;

 private:
  /// The row of corners above pixels y. There is none above the first; the last one, which holds 0, does for
  /// it.
  int corner_above(int y) const { return y > 0 ? y - 1 : dd.rows - 1; }
  /// `line` holds a row between rows.
  void coarsen_row(int y, std::vector<float>& line, MotionOperator& coarse) const;
};

}  // namespace esi
