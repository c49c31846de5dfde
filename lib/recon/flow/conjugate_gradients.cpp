#include "esi/recon/flow/conjugate_gradients.hpp"

#include <algorithm>

#include "esi/recon/flow/padded_plane.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// y += factor x
ESI_SIMD void add_scaled(int count, float factor, const float* __restrict x, float* __restrict y) {
  for (int i = 0; i < count; ++i) y[i] += factor * x[i];
}

/// direction = keep direction + inverse residual
ESI_SIMD void turn_row(int count, float keep, const float* __restrict inverse,
                       const float* __restrict residual, float* __restrict direction) {
  for (int i = 0; i < count; ++i) direction[i] = keep * direction[i] + inverse[i] * residual[i];
}

/// residual -= step product; returns residual . inverse residual
ESI_SIMD double go_row(int padded_cols, float step, const float* __restrict product,
                       const float* __restrict inverse, float* __restrict residual) {
  float sums[kVectorFloats] = {};
  for (int i = 0; i < padded_cols; i += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) {
      const float left = residual[i + k] - step * product[i + k];
      residual[i + k] = left;
      sums[k] += left * left * inverse[i + k];
    }
  }
  return sum_of(sums);
}

}  // namespace

ConjugateGradients::ConjugateGradients(cv::Size size)
    : inverse_diagonal_(padded_plane(size)), direction_(padded_plane(size)), product_(padded_plane(size)) {}

void ConjugateGradients::add_steps(const MotionOperator& normal, int steps, cv::Mat1f& residual,
                                   cv::Mat1f& solution, const RowTeam& team) {
  double remaining = begin(normal, residual, team);
  for (int i = 0; i < steps && remaining > kNothing; ++i) {
    const double energy = make_product(normal, team);
    if (energy < kNothing) return;
    const double next = go(static_cast<float>(remaining / energy), residual, solution, team);
    turn(static_cast<float>(next / remaining), residual, team);
    remaining = next;
  }
}

double ConjugateGradients::begin(const MotionOperator& normal, const cv::Mat1f& residual,
                                 const RowTeam& team) {
  const int cols = padded(residual.cols);
  return sum_over_rows(team, residual.size(), [&](int y) {
    std::fill_n(direction_[y], cols, 0.0F);
    normal.inverse_diagonal_row(y, inverse_diagonal_[y]);
    turn_row(cols, 0.0F, inverse_diagonal_[y], residual[y], direction_[y]);
    return dot(direction_[y], residual[y], cols);
  });
}

double ConjugateGradients::make_product(const MotionOperator& normal, const RowTeam& team) {
  return sum_over_rows(team, direction_.size(), [&](int y) {
    normal.apply_row(direction_, y, product_[y]);
    return dot(direction_[y], product_[y], padded(direction_.cols));
  });
}

double ConjugateGradients::go(float step, cv::Mat1f& residual, cv::Mat1f& solution, const RowTeam& team) {
  return sum_over_rows(team, residual.size(), [&](int y) {
    add_scaled(solution.cols, step, direction_[y], solution[y]);
    return go_row(padded(residual.cols), step, product_[y], inverse_diagonal_[y], residual[y]);
  });
}

void ConjugateGradients::turn(float keep, const cv::Mat1f& residual, const RowTeam& team) {
  team.over_rows(residual.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      turn_row(padded(residual.cols), keep, inverse_diagonal_[y], residual[y], direction_[y]);
  });
}

}  // namespace esi
