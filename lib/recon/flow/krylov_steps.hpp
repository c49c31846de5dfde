#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/conjugate_gradients.hpp"
#include "esi/recon/flow/krylov_products.hpp"
#include "esi/recon/flow/motion_operator.hpp"

namespace esi {

/// A step that comes first: along a vector, of which the product with M is there already. Padded planes.
struct FirstStep {
  float length;
  cv::Mat1f direction, product;
};

/// Several steps of conjugate gradients (Jacobi's preconditioner) at once. n steps find the point of least
/// energy among the combinations of n vectors, for which any basis will do. With D the diagonal of M we take
///   z_0 = D^-1 r,   z_k = T_k(X) z_0,   X = D^-1 M / 2 - 1                                        (9)
/// T_k being Chebyshev's polynomials: the eigenvalues of D^-1 M lie in (0, 4], since a corner's energy is at
/// most 4 times that of its diagonal, so that those of X lie in (-1, 1]. Row y of z_k needs rows y - 1 to y +
/// 1 of z_(k-1) only: all n come into being in one pass over the image, while a few rows of everything stay
/// in cache.
class KrylovSteps {
 public:
  /// More than six steps are taken one after another, and so are those on an image of a few pixels.
  KrylovSteps(cv::Size size, int steps);

  /// Adds to `solution` the first step and what the others make of the residual then. `residual` is a padded
  /// plane, and is used up.
  void add_to(cv::Mat1f& solution, const MotionOperator& normal, const FirstStep& first, cv::Mat1f& residual,
              const RowTeam& team = kAlone);

 private:
  struct LatestRows;

  /// Takes the first step out of the residual on the way.
  void make_basis(const MotionOperator& normal, const FirstStep& first, cv::Mat1f& residual,
                  const RowTeam& team);
  void make_first_row(const float* inverse, const cv::Mat1f& residual, int y);
  /// Row y of z_k, unless that is one too many, and what M z_(k-1), which goes to `product`, gives to the
  /// products there.
  void make_next_row(const MotionOperator& normal, const float* inverse, const cv::Mat1f& residual, int k,
                     int y, float* product);
  /// sum += the first step and the combination of least energy
  void add_basis(cv::Mat1f& sum, const FirstStep& first, const RowTeam& team) const;
  /// The sum of all rows' products, in their order.
  std::vector<KrylovProducts> products() const;
  KrylovProducts& products_of(int y, std::size_t k) {
    return row_products_[static_cast<std::size_t>(y) * basis_.size() + k];
  }

  int one_by_one_;
  ConjugateGradients conjugate_gradients_;
  std::vector<cv::Mat1f> basis_;
  std::vector<KrylovProducts> row_products_;  ///< by row, then by vector
};

}  // namespace esi
