#pragma once

#include <opencv2/core/mat.hpp>

#include "esi/core/row_team.hpp"
#include "esi/recon/flow/cell_grid.hpp"
#include "esi/recon/flow/motion_estimator.hpp"
#include "esi/recon/flow/motion_operator.hpp"

namespace esi {

struct RowMotion;

/// What all windows so far say about log intensity L, carried along with the motion v (px a window): b = -v .
/// grad L in each, as a least-squares problem
///   L = argmin sum grad L^T A grad L - 2 a^T grad L + eps |grad L|^2 + mu L^2                    (4)
/// A and a are of the corners between pixels, as those of MotionOperator are.
class BrightnessModel {
 public:
  struct Options {
    float eps;        ///< smoothness, px^2
    float mu;         ///< pull towards 0
    double memory;    ///< what is left after 10 ms, even without motion
    float memory_px;  ///< ell: after this path half of it is forgotten
  };

  BrightnessModel(cv::Size size, const Options& options);

  /// Takes a window of events b, D * 10 ms long, that moved by `field`:
  ///   A <- lambda A + v v^T / D,   a <- lambda a(x - v) - v b(x - v/2) / D,   L <- L(x - v),
  ///   lambda = memory^D / (1 + |v| / memory_px)                                                   (5)
  void take(const cv::Mat1f& b, double duration, const MotionField& field, const CellGrid& cells,
            const RowTeam& team = kAlone);

  /// The problem's right-hand side: minus the divergence of a.
  void right_hand_side(cv::Mat1f& rhs, const RowTeam& team = kAlone) const;

  /// The image as it will be after `share` of a window's motion.
  void move_image(const MotionField& field, const CellGrid& cells, float share, cv::Mat1f& moved,
                  const RowTeam& team = kAlone) const;

  /// Where a motion turned out to be the opposite: L and a, which change their signs with it, times these
  /// factors, which are of cells. A has v twice and stays.
  void turn(const cv::Mat1f& signs, CellGrid cells);

  MotionOperator& normal_operator() { return operator_; }

  cv::Mat1f& log_intensity() { return log_intensity_; }

 private:
  /// `moved_b` has as many entries as there are columns.
  void move_row(int y, const cv::Mat1f& b, RowMotion& motion, float* moved_b);
  void right_hand_side_row(int y, const float* none, cv::Mat1f& rhs) const;

  Options options_;
  float memory_ = 1.0F, weight_ = 1.0F;  ///< memory^D and 1 / D of the window that is being taken
  MotionOperator operator_;
  cv::Mat1f a_d_, a_e_;  ///< a = (a_d + a_e, a_d - a_e): a . grad L = a_d D + a_e E
  cv::Mat1f log_intensity_;
  cv::Mat1f moved_d_, moved_e_, moved_l_;
};

}  // namespace esi
