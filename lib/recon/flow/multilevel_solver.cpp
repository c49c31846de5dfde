#include "esi/recon/flow/multilevel_solver.hpp"

#include <numeric>

#include "esi/recon/flow/double_size.hpp"
#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/padded_plane.hpp"
#include "esi/recon/flow/row_stages.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// y = x - y
ESI_SIMD void subtract_from(int count, const float* __restrict x, float* __restrict y) {
  for (int i = 0; i < count; ++i) y[i] = x[i] - y[i];
}

}  // namespace

MultilevelSolver::MultilevelSolver(cv::Size size, const Options& options) {
  for (std::size_t i = 0; i < options.steps.size(); ++i) {
    const cv::Size own = i == 0 ? cv::Size(1, 1) : size;
    levels_.push_back({MotionOperator(own), padded_plane(size), cv::Mat1f(size), padded_plane(size),
                       padded_plane(size), KrylovSteps(size, options.steps[i])});
    size = half_of(size);
  }
}

void MultilevelSolver::solve(const MotionOperator& fine, const cv::Mat1f& rhs, int cycles,
                             cv::Mat1f& solution, const RowTeam& team) {
  fine_ = &fine;
  for (std::size_t i = 1; i < levels_.size(); ++i) operator_of(i - 1).coarsen(levels_[i].normal, team);
  for (int i = 0; i < cycles; ++i) cycle(rhs, solution, team);
}

void MultilevelSolver::make_residual(const cv::Mat1f& rhs, const cv::Mat1f& solution, const RowTeam& team) {
  cv::Mat1f& residual = levels_.front().residual;
  team.over_rows(rhs.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      fine_->apply_row(solution, y, residual[y]);
      subtract_from(rhs.cols, rhs[y], residual[y]);
    }
  });
}

void MultilevelSolver::cycle(const cv::Mat1f& rhs, cv::Mat1f& solution, const RowTeam& team) {
  make_residual(rhs, solution, team);
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    sum_by_twos(levels_[i - 1].residual, 1.0F, levels_[i].residual, team);
    levels_[i].correction.setTo(0.0F);
  }
  for (std::size_t i = levels_.size(); i-- > 0;) {
    Level& level = levels_[i];
    const float length =
        i + 1 < levels_.size() ? take_correction(levels_[i + 1], level, operator_of(i), team) : 0.0F;
    level.steps.add_to(i == 0 ? solution : level.correction, operator_of(i),
                       {length, level.direction, level.product}, level.residual, team);
  }
}

float MultilevelSolver::take_correction(const Level& coarse, Level& level, const MotionOperator& normal,
                                        const RowTeam& team) {
  const cv::Size size = level.residual.size();
  const int cols = padded(size.width);
  std::vector<double> descents(static_cast<std::size_t>(size.height));
  std::vector<double> energies(descents.size());
  const auto multiply = [&](int y) {
    normal.apply_row(level.direction, y, level.product[y]);
    energies[static_cast<std::size_t>(y)] = dot(level.direction[y], level.product[y], cols);
  };
  const auto piece = [&]() -> StageRow {
    return [&, doubled = DoubleSize(coarse.correction)](int k, int y) mutable {
      if (k == 1) return multiply(y);
      doubled.row(y, size.width, level.direction[y]);
      descents[static_cast<std::size_t>(y)] = dot(level.direction[y], level.residual[y], cols);
    };
  };
  over_stages(team, size, 2, piece, [&] { return [&](int /*k*/, int y) { multiply(y); }; });
  const double energy = std::accumulate(energies.begin(), energies.end(), 0.0);
  const double descent = std::accumulate(descents.begin(), descents.end(), 0.0);
  return energy < kNothing ? 0.0F : static_cast<float>(descent / energy);
}

}  // namespace esi
