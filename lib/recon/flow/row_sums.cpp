#include "esi/recon/flow/row_sums.hpp"

#include "esi/recon/flow/simd.hpp"

namespace esi {
namespace {

/// Sums side by side, so that they can be vectorised without reordering.
constexpr int kLanes = 32;

}  // namespace

ESI_SIMD double dot(const float* __restrict a, const float* __restrict b, int count) {
  float lanes[kLanes] = {};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int k = 0; k < kLanes; ++k) lanes[k] += a[i + k] * b[i + k];
  }
  double sum = 0.0;
  for (; i < count; ++i) sum += static_cast<double>(a[i] * b[i]);
  for (const float lane : lanes) sum += static_cast<double>(lane);
  return sum;
}

ESI_SIMD double step_along(int count, float step, const float* __restrict direction,
                           const float* __restrict product, const float* __restrict inverse_diagonal,
                           float* __restrict solution, float* __restrict residual) {
  float lanes[kLanes] = {};
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (int k = 0; k < kLanes; ++k) {
      const int j = i + k;
      solution[j] += step * direction[j];
      const float left = residual[j] - step * product[j];
      residual[j] = left;
      lanes[k] += left * left * inverse_diagonal[j];
    }
  }
  double sum = 0.0;
  for (; i < count; ++i) {
    solution[i] += step * direction[i];
    residual[i] -= step * product[i];
    sum += static_cast<double>(residual[i] * residual[i] * inverse_diagonal[i]);
  }
  for (const float lane : lanes) sum += static_cast<double>(lane);
  return sum;
}

}  // namespace esi
