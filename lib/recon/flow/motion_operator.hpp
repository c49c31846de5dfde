#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

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

  /// out = M in; returns in . M in. `in` and `out` are continuous, of this size, and not the same.
  double apply(const cv::Mat1f& in, cv::Mat1f& out);

  /// 1 / the diagonal of M.
  void invert_diagonal(cv::Mat1f& inverse) const;

  /// The same problem on half the resolution. In two dimensions the energy of a gradient doesn't depend on
  /// the pixels' size, that of mu does.
  void coarsen(MotionOperator& coarse) const;

  cv::Mat1f dd, de, ee;
  float eps = 0.0F;
  float mu = 0.0F;

 private:
  /// Flux through the corners below row y, along the diagonals; entry x + 1 is corner x.
  void flux_of(const cv::Mat1f& in, int y, std::vector<float>& d, std::vector<float>& e) const;

  std::vector<float> above_d_, above_e_, below_d_, below_e_;
};

}  // namespace esi
