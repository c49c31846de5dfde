#pragma once

#include <opencv2/core/mat.hpp>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/motion_operator.hpp"

namespace esi {

/// Steps of conjugate gradients (Hestenes and Stiefel, 1952; Jacobi's preconditioner), one after another.
class ConjugateGradients {
 public:
  explicit ConjugateGradients(cv::Size size);

  /// Adds to `solution` what so many steps make of `residual`, a padded plane, and takes that out of it.
  void add_steps(const MotionOperator& normal, int steps, cv::Mat1f& residual, cv::Mat1f& solution,
                 const RowTeam& team = kAlone);

 private:
  /// direction = D^-1 residual; returns direction . residual
  double begin(const MotionOperator& normal, const cv::Mat1f& residual, const RowTeam& team);
  /// Returns direction . M direction.
  double make_product(const MotionOperator& normal, const RowTeam& team);
  /// Returns residual . D^-1 residual, then.
  double go(float step, cv::Mat1f& residual, cv::Mat1f& solution, const RowTeam& team);
  void turn(float keep, const cv::Mat1f& residual, const RowTeam& team);

  cv::Mat1f inverse_diagonal_, direction_, product_;
};

}  // namespace esi
