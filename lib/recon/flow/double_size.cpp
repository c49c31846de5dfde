#include "esi/recon/flow/double_size.hpp"

#include <algorithm>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

ESI_SIMD void mix(int cols, const float* __restrict near, const float* __restrict far,
                  float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = 0.75F * near[x] + 0.25F * far[x];
}

/// Pixel 2 x lies a quarter left of coarse pixel x, pixel 2 x + 1 right of it.
ESI_SIMD void double_row(int cols, const float* __restrict line, float* __restrict out) {
  const int pairs = cols / 2;
  for (int x = 0; x < pairs; ++x) {
    const int i = 2 * x;
    out[i] = 0.75F * line[x + 1] + 0.25F * line[x];
    out[i + 1] = 0.75F * line[x + 1] + 0.25F * line[x + 2];
  }
  if (cols % 2 == 1) out[cols - 1] = 0.75F * line[pairs + 1] + 0.25F * line[pairs];
}

}  // namespace

DoubleSize::DoubleSize(const cv::Mat1f& coarse)
    : coarse_(coarse), line_(static_cast<std::size_t>(coarse.cols) + 2) {}

void DoubleSize::row(int y, int cols, float* out) {
  const int near = y / 2;
  const int far = std::clamp(y % 2 == 0 ? near - 1 : near + 1, 0, coarse_.rows - 1);
  mix(coarse_.cols, coarse_[near], coarse_[far], line_.data() + 1);
  line_.front() = line_[1];
  line_.back() = line_[line_.size() - 2];
  double_row(cols, line_.data(), out);
}

}  // namespace esi
