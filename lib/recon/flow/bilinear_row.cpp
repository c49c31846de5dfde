#include "esi/recon/flow/bilinear_row.hpp"

#include <algorithm>

#include "esi/recon/flow/simd.hpp"

namespace esi {
namespace {

ESI_SIMD void place_row(int cols, int rows, int y, const float* __restrict vx, const float* __restrict vy,
                        float scale, float offset, int* __restrict index, float* __restrict right,
                        float* __restrict below) {
  const auto last_x = static_cast<float>(cols - 1);
  const auto last_y = static_cast<float>(rows - 1);
  const int last_left = std::max(cols - 2, 0);
  const int last_above = std::max(rows - 2, 0);
  for (int x = 0; x < cols; ++x) {
    const float at_x = std::min(std::max(static_cast<float>(x) + offset - scale * vx[x], 0.0F), last_x);
    const float at_y = std::min(std::max(static_cast<float>(y) + offset - scale * vy[x], 0.0F), last_y);
    const int left = std::min(static_cast<int>(at_x), last_left);
    const int above = std::min(static_cast<int>(at_y), last_above);
    index[x] = above * cols + left;
    right[x] = at_x - static_cast<float>(left);
    below[x] = at_y - static_cast<float>(above);
  }
}

ESI_SIMD void sample_row(int cols, const float* __restrict image, const float* __restrict image_right,
                         const float* __restrict image_below, const float* __restrict image_both,
                         const int* __restrict index, const float* __restrict right,
                         const float* __restrict below, float* __restrict out) {
  for (int x = 0; x < cols; ++x) {
    const int i = index[x];
    const float upper = image[i] + right[x] * (image_right[i] - image[i]);
    const float lower = image_below[i] + right[x] * (image_both[i] - image_below[i]);
    out[x] = upper + below[x] * (lower - upper);
  }
}

}  // namespace

BilinearRow::BilinearRow(cv::Size size)
    : size_(size),
      index_(static_cast<std::size_t>(size.width)),
      right_(index_.size()),
      below_(index_.size()) {}

void BilinearRow::place(int y, const float* vx, const float* vy, float scale, float offset) {
  place_row(size_.width, size_.height, y, vx, vy, scale, offset, index_.data(), right_.data(), below_.data());
}

void BilinearRow::sample(const cv::Mat1f& image, float* out) const {
  // A single column or row is its own neighbour.
  const int right = size_.width > 1 ? 1 : 0;
  const int below = size_.height > 1 ? size_.width : 0;
  const float* const origin = image[0];
  sample_row(size_.width, origin, origin + right, origin + below, origin + below + right, index_.data(),
             right_.data(), below_.data(), out);
}

}  // namespace esi
