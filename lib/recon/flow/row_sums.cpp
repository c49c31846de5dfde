#include "esi/recon/flow/row_sums.hpp"

#include <numeric>
#include <vector>

#include "esi/recon/simd.hpp"

namespace esi {

ESI_SIMD double sum(const float* __restrict a, int count) {
  float sums[kVectorFloats] = {};
  int i = 0;
  for (; i + kVectorFloats <= count; i += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) sums[k] += a[i + k];
  }
  double rest = 0.0;
  for (; i < count; ++i) rest += static_cast<double>(a[i]);
  return rest + sum_of(sums);
}

ESI_SIMD double dot(const float* __restrict a, const float* __restrict b, int count) {
  float sums[kVectorFloats] = {};
  int i = 0;
  for (; i + kVectorFloats <= count; i += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) sums[k] += a[i + k] * b[i + k];
  }
  double rest = 0.0;
  for (; i < count; ++i) rest += static_cast<double>(a[i] * b[i]);
  return rest + sum_of(sums);
}

double sum_over_rows(const RowTeam& team, cv::Size image, const std::function<double(int y)>& of_row) {
  std::vector<double> sums(static_cast<std::size_t>(image.height));
  team.over_rows(image, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) sums[static_cast<std::size_t>(y)] = of_row(y);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace esi
