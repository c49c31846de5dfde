#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/recon/flow/krylov_steps.hpp"
#include "esi/recon/flow/motion_operator.hpp"

namespace esi {

/// Solves M L = rhs from a good guess: what is wrong on a large scale is put right on coarse grids, where it
/// is cheap.
class MultilevelSolver {
 public:
  struct Options {
    /// Steps of conjugate gradients at full resolution, at half, and so on.
    std::vector<int> steps;
  };

  MultilevelSolver(cv::Size size, const Options& options);

  /// Improves `solution`. A cycle restricts the residual to every level; from the coarsest on each level runs
  /// its steps of conjugate gradients (Jacobi's preconditioner) on what the level below it left. A correction
  /// e that goes up is scaled by r . e / e . M e, which makes the energy least along it              (8)
  void solve(const MotionOperator& fine, const cv::Mat1f& rhs, int cycles, cv::Mat1f& solution,
             const RowTeam& team = kAlone);

 private:
  struct Level {
    MotionOperator normal;
    cv::Mat1f residual, correction;
    cv::Mat1f direction, product;  ///< the correction from below, and M times it
    KrylovSteps steps;
  };

  void cycle(const cv::Mat1f& rhs, cv::Mat1f& solution, const RowTeam& team);
  void make_residual(const cv::Mat1f& rhs, const cv::Mat1f& solution, const RowTeam& team);
  /// Brings coarse's correction to this level, with its product; returns how far to go along it, equation
  /// (8).
  static float take_correction(const Level& coarse, Level& level, const MotionOperator& normal,
                               const RowTeam& team);

  const MotionOperator& operator_of(std::size_t level) const {
    return level == 0 ? *fine_ : levels_[level].normal;
  }

  std::vector<Level> levels_;  ///< from the full resolution on, whose operator is the caller's
  const MotionOperator* fine_ = nullptr;
};

}  // namespace esi
