#include "esi/recon/flow/multilevel_solver.hpp"

#include <algorithm>

#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/flow/simd.hpp"

namespace esi {
namespace {

int count_of(const cv::Mat1f& image) { return static_cast<int>(image.total()); }

ESI_SIMD void subtract(int count, const float* __restrict a, const float* __restrict b,
                       float* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = a[i] - b[i];
}

ESI_SIMD void multiply(int count, const float* __restrict a, const float* __restrict b,
                       float* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = a[i] * b[i];
}

/// y += factor x
ESI_SIMD void add_scaled(int count, float factor, const float* __restrict x, float* __restrict y) {
  for (int i = 0; i < count; ++i) y[i] += factor * x[i];
}

/// direction = factor direction + inverse_diagonal residual
ESI_SIMD void turn(int count, float factor, const float* __restrict inverse_diagonal,
                   const float* __restrict residual, float* __restrict direction) {
  for (int i = 0; i < count; ++i) direction[i] = factor * direction[i] + inverse_diagonal[i] * residual[i];
}

/// A row twice as long, bilinearly: pixel 2 x lies a quarter left of coarse pixel x, pixel 2 x + 1 right of
/// it.
ESI_SIMD void double_row(int coarse_cols, const float* __restrict line, float* __restrict out) {
  for (int x = 0; x < coarse_cols; ++x) {
    const int i = 2 * x;
    out[i] = 0.75F * line[x + 1] + 0.25F * line[x];
    out[i + 1] = 0.75F * line[x + 1] + 0.25F * line[x + 2];
  }
}

ESI_SIMD void mix(int cols, const float* __restrict near, const float* __restrict far,
                  float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = 0.75F * near[x] + 0.25F * far[x];
}

/// Twice the resolution, bilinearly; outside, the border goes on.
void double_size(const cv::Mat1f& coarse, cv::Mat1f& fine) {
  std::vector<float> line(static_cast<std::size_t>(coarse.cols) + 2);
  std::vector<float> doubled(2 * static_cast<std::size_t>(coarse.cols));
  for (int y = 0; y < fine.rows; ++y) {
    const int near = y / 2;
    const int far = std::clamp(y % 2 == 0 ? near - 1 : near + 1, 0, coarse.rows - 1);
    mix(coarse.cols, coarse[near], coarse[far], line.data() + 1);
    line.front() = line[1];
    line.back() = line[static_cast<std::size_t>(coarse.cols)];
    double_row(coarse.cols, line.data(), doubled.data());
    std::copy_n(doubled.data(), fine.cols, fine[y]);
  }
}

/// Where there is nothing left to improve, or no direction to do it in.
constexpr double kNothing = 1e-30;

}  // namespace

MultilevelSolver::MultilevelSolver(cv::Size size, const Options& options) : options_(options) {
  for (std::size_t i = 0; i < options.steps.size(); ++i) {
    const cv::Size own = i == 0 ? cv::Size(1, 1) : size;
    levels_.push_back({MotionOperator(own), cv::Mat1f(size), cv::Mat1f(size), {}, cv::Mat1f(size), {}});
    size = half_of(size);
  }
}

void MultilevelSolver::solve(MotionOperator& fine, const cv::Mat1f& rhs, int cycles, cv::Mat1f& solution) {
  fine_ = &fine;
  for (std::size_t i = 1; i < levels_.size(); ++i) operator_of(i - 1).coarsen(levels_[i].normal);
  for (std::size_t i = 0; i < levels_.size(); ++i)
    operator_of(i).invert_diagonal(levels_[i].inverse_diagonal);
  for (int i = 0; i < cycles; ++i) cycle(rhs, solution);
}

void MultilevelSolver::cycle(const cv::Mat1f& rhs, cv::Mat1f& solution) {
  Level& finest = levels_.front();
  fine_->apply(solution, finest.product);
  subtract(count_of(rhs), rhs[0], finest.product[0], finest.residual[0]);
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    sum_by_twos(levels_[i - 1].residual, 1.0F, levels_[i].residual);
    levels_[i].correction.setTo(0.0F);
  }
  for (std::size_t i = levels_.size(); i-- > 0;) {
    cv::Mat1f& target = i == 0 ? solution : levels_[i].correction;
    if (i + 1 < levels_.size()) take_correction(levels_[i + 1], levels_[i], operator_of(i), target);
    conjugate_gradients(levels_[i], operator_of(i), options_.steps[i], target);
  }
}

void MultilevelSolver::take_correction(const Level& coarse, Level& level, MotionOperator& normal,
                                       cv::Mat1f& correction) {
  double_size(coarse.correction, level.direction);
  const double energy = normal.apply(level.direction, level.product);
  const int count = count_of(level.residual);
  if (energy < kNothing) return;
  const auto step = static_cast<float>(dot(level.direction[0], level.residual[0], count) / energy);
  add_scaled(count, step, level.direction[0], correction[0]);
  add_scaled(count, -step, level.product[0], level.residual[0]);
}

void MultilevelSolver::conjugate_gradients(Level& level, MotionOperator& normal, int steps,
                                           cv::Mat1f& solution) {
  const int count = count_of(level.residual);
  const float* const inverse = level.inverse_diagonal[0];
  float* const residual = level.residual[0];
  float* const direction = level.direction[0];
  multiply(count, inverse, residual, direction);
  double remaining = dot(direction, residual, count);
  for (int i = 0; i < steps && remaining > kNothing; ++i) {
    const double energy = normal.apply(level.direction, level.product);
    if (energy < kNothing) return;
    const double next = step_along(count, static_cast<float>(remaining / energy), direction, level.product[0],
                                   inverse, solution[0], residual);
    turn(count, static_cast<float>(next / remaining), inverse, residual, direction);
    remaining = next;
  }
}

}  // namespace esi
