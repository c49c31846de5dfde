#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/recon/flow/krylov_products.hpp"
#include "esi/recon/flow/motion_operator.hpp"

namespace esi {

/// Several steps of conjugate gradients (Jacobi's preconditioner) at once. n steps find the point of least
/// energy among the combinations of n vectors, for which any basis will do. With D the diagonal of M we take
///   z_0 = D^-1 r,   z_k = T_k(X) z_0,   X = D^-1 M / 2 - 1                                        (9)
/// T_k being Chebyshev's polynomials: the eigenvalues of D^-1 M lie in (0, 4], since a corner's energy is at
/// most 4 times that of its diagonal, so that those of X lie in (-1, 1]. Row y of z_k needs rows y - 1 to y +
/// 1 of z_(k-1) only: all n come into being in one pass over the image, while a few rows of everything stay
/// in cache.
class KrylovSteps {
 public:
  /// At most kMostAtOnce steps share a pass.
  KrylovSteps(cv::Size size, int steps);

  /// Adds to `solution` what the steps make of `residual`, a padded plane, which is used up.
  void add_to(cv::Mat1f& solution, const MotionOperator& normal, cv::Mat1f& residual);

 private:
  static constexpr int kMostAtOnce = 12;

  void make_basis(const MotionOperator& normal, const cv::Mat1f& residual, int count);
  /// Row y of z_k, and what M z_(k-1) gives to the products there.
  void make_row(const MotionOperator& normal, const cv::Mat1f& residual, int k, int y);
  float* inverse_row(int y) { return inverse_[y % inverse_.rows]; }

  int steps_;
  std::vector<cv::Mat1f> basis_;
  std::vector<KrylovProducts> products_;
  cv::Mat1f inverse_;  ///< diagonal: its latest rows
  cv::Mat1f product_;  ///< a row of M z_k
};

}  // namespace esi
