#include "esi/recon/flow/krylov_steps.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "esi/recon/flow/padded_plane.hpp"
#include "esi/recon/flow/row_stages.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// residual -= length product
ESI_SIMD void take_out(int padded_cols, float length, const float* __restrict product,
                       float* __restrict residual) {
  for (int i = 0; i < padded_cols; ++i) residual[i] -= length * product[i];
}

/// out = D^-1 r; returns out . r
ESI_SIMD double first_row(int padded_cols, const float* __restrict inverse, const float* __restrict residual,
                          float* __restrict out) {
  float sums[kVectorFloats] = {};
  for (int i = 0; i < padded_cols; i += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) {
      out[i + k] = inverse[i + k] * residual[i + k];
      sums[k] += out[i + k] * residual[i + k];
    }
  }
  return sum_of(sums);
}

/// next = turn X z - keep before, where `product` is M z. Adds to sums z . M z, next . M z and next . r.
ESI_SIMD void next_row(int padded_cols, float turn, float keep, const float* __restrict inverse,
                       const float* __restrict residual, const float* __restrict product,
                       const float* __restrict before, const float* __restrict z, float* __restrict next,
                       double* __restrict sums) {
  float itself[kVectorFloats] = {};
  float crossed[kVectorFloats] = {};
  float right[kVectorFloats] = {};
  for (int i = 0; i < padded_cols; i += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) {
      const int x = i + k;
      const float value = turn * (0.5F * inverse[x] * product[x] - z[x]) - keep * before[x];
      next[x] = value;
      itself[k] += product[x] * z[x];
      crossed[k] += product[x] * value;
      right[k] += residual[x] * value;
    }
  }
  sums[0] += sum_of(itself);
  sums[1] += sum_of(crossed);
  sums[2] += sum_of(right);
}

/// sum += factors . rows
ESI_SIMD void add_combination(int cols, int count, const float* __restrict factors,
                              const float* const* __restrict rows, float* __restrict sum) {
  int i = 0;
  for (; i + kVectorFloats <= cols; i += kVectorFloats) {
    float value[kVectorFloats];
    for (int k = 0; k < kVectorFloats; ++k) value[k] = sum[i + k];
    for (int row = 0; row < count; ++row) {
      for (int k = 0; k < kVectorFloats; ++k) value[k] += factors[row] * rows[row][i + k];
    }
    for (int k = 0; k < kVectorFloats; ++k) sum[i + k] = value[k];
  }
  for (; i < cols; ++i) {
    for (int row = 0; row < count; ++row) sum[i] += factors[row] * rows[row][i];
  }
}

constexpr int kMostAtOnce = 6;
constexpr int kLeastPixels = 64;

/// Of more steps, or where they nearly solve the problem, a basis is lost in float's rounding. An image of
/// one row or column has no corners: eps and mu alone are soon solved.
bool loses_itself(cv::Size size, int steps) {
  return steps > kMostAtOnce || size.area() < kLeastPixels || std::min(size.width, size.height) == 1;
}

}  // namespace

/// What a part of the work needs for itself.
struct KrylovSteps::LatestRows {
  explicit LatestRows(int cols)
      : inverses(padded_plane({cols, kMostAtOnce + 1})), product(padded_plane({cols, 1})) {}

  float* inverse(int y) { return inverses[y % inverses.rows]; }

  cv::Mat1f inverses;  ///< of the diagonal
  cv::Mat1f product;   ///< a row of M z_k
};

KrylovSteps::KrylovSteps(cv::Size size, int steps)
    : one_by_one_(loses_itself(size, steps) ? steps : 0),
      conjugate_gradients_(one_by_one_ > 0 ? size : cv::Size(1, 1)) {
  for (int k = 0; k < steps - one_by_one_; ++k) basis_.push_back(padded_plane(size));
  row_products_.resize(static_cast<std::size_t>(size.height) * basis_.size());
}

void KrylovSteps::add_to(cv::Mat1f& solution, const MotionOperator& normal, const FirstStep& first,
                         cv::Mat1f& residual, const RowTeam& team) {
  make_basis(normal, first, residual, team);
  add_basis(solution, first, team);
  if (one_by_one_ > 0) conjugate_gradients_.add_steps(normal, one_by_one_, residual, solution, team);
}

void KrylovSteps::add_basis(cv::Mat1f& sum, const FirstStep& first, const RowTeam& team) const {
  std::vector<float> factors = least_energy_factors(products());
  factors.push_back(first.length);
  team.over_rows(sum.size(), [&](int begin, int end) {
    std::vector<const float*> rows(factors.size());
    for (int y = begin; y < end; ++y) {
      for (std::size_t k = 0; k < basis_.size(); ++k) rows[k] = basis_[k][y];
      rows.back() = first.direction[y];
      add_combination(sum.cols, static_cast<int>(rows.size()), factors.data(), rows.data(), sum[y]);
    }
  });
}

std::vector<KrylovProducts> KrylovSteps::products() const {
  std::vector<KrylovProducts> sums(basis_.size());
  for (std::size_t i = 0; i < row_products_.size(); ++i) {
    KrylovProducts& sum = sums[i % sums.size()];
    sum.own += row_products_[i].own;
    sum.next += row_products_[i].next;
    sum.residual += row_products_[i].residual;
  }
  return sums;
}

void KrylovSteps::make_basis(const MotionOperator& normal, const FirstStep& first, cv::Mat1f& residual,
                             const RowTeam& team) {
  const int cols = residual.cols;
  const auto piece = [&]() -> StageRow {
    return [&, rows = LatestRows(cols)](int k, int y) mutable {
      if (k > 0) return make_next_row(normal, rows.inverse(y), residual, k, y, rows.product[0]);
      take_out(padded(cols), first.length, first.product[y], residual[y]);
      if (basis_.empty()) return;
      normal.inverse_diagonal_row(y, rows.inverse(y));
      make_first_row(rows.inverse(y), residual, y);
    };
  };
  const auto seam = [&]() -> StageRow {
    return [&, rows = LatestRows(cols)](int k, int y) mutable {
      normal.inverse_diagonal_row(y, rows.inverse(y));
      make_next_row(normal, rows.inverse(y), residual, k, y, rows.product[0]);
    };
  };
  over_stages(team, residual.size(), static_cast<int>(basis_.size()) + 1, piece, seam);
}

void KrylovSteps::make_first_row(const float* inverse, const cv::Mat1f& residual, int y) {
  products_of(y, 0).residual = first_row(padded(residual.cols), inverse, residual[y], basis_[0][y]);
}

void KrylovSteps::make_next_row(const MotionOperator& normal, const float* inverse, const cv::Mat1f& residual,
                                int k, int y, float* product) {
  const int cols = padded(residual.cols);
  const auto own = static_cast<std::size_t>(k);
  const cv::Mat1f& last = basis_[own - 1];
  KrylovProducts& products = products_of(y, own - 1);
  normal.apply_row(last, y, product);
  if (own == basis_.size()) {
    products.own = dot(product, last[y], cols);
    return;
  }
  const cv::Mat1f& before = basis_[own - std::min(own, std::size_t{2})];
  double sums[3] = {};
  next_row(cols, k == 1 ? 1.0F : 2.0F, k == 1 ? 0.0F : 1.0F, inverse, residual[y], product, before[y],
           last[y], basis_[own][y], sums);
  products.own = sums[0];
  products.next = sums[1];
  products_of(y, own).residual = sums[2];
}

}  // namespace esi
