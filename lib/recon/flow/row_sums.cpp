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

}  // namespace esi
