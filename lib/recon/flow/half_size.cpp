#include "esi/recon/flow/half_size.hpp"

#include <algorithm>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

ESI_SIMD void sum_rows(int pairs, const float* __restrict upper, const float* __restrict lower, float factor,
                       float* __restrict out) {
  for (int x = 0; x < pairs; ++x) {
    const int i = 2 * x;
    out[x] = factor * ((upper[i] + upper[i + 1]) + (lower[i] + lower[i + 1]));
  }
}

void sum_row_by_twos(const cv::Mat1f& image, float factor, int y, cv::Mat1f& half) {
  const float* const upper = image[2 * y];
  const float* const lower = image[std::min(2 * y + 1, image.rows - 1)];
  sum_rows(image.cols / 2, upper, lower, factor, half[y]);
  if (image.cols % 2 == 1)
    half(y, half.cols - 1) = 2.0F * factor * (upper[image.cols - 1] + lower[image.cols - 1]);
}

}  // namespace

void sum_by_twos(const cv::Mat1f& image, float factor, cv::Mat1f& half, const RowTeam& team) {
  half.create(half_of(image.size()));
  team.over_rows(half.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) sum_row_by_twos(image, factor, y, half);
  });
}

}  // namespace esi
