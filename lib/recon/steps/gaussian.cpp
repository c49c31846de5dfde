#include "esi/recon/steps/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

constexpr double kReach = 3.0;

std::vector<float> half_kernel(double deviation_px, int reach_px) {
  std::vector<double> half(static_cast<std::size_t>(reach_px) + 1);
  for (std::size_t i = 0; i < half.size(); ++i) {
    const double deviations = static_cast<double>(i) / deviation_px;
    half[i] = std::exp(-0.5 * deviations * deviations);
  }
  const double sum = 2.0 * std::accumulate(half.begin(), half.end(), 0.0) - half.front();
  std::vector<float> weights(half.size());
  std::transform(half.begin(), half.end(), weights.begin(),
                 [sum](double weight) { return static_cast<float>(weight / sum); });
  return weights;
}

ESI_SIMD void scale(int cols, float weight, const float* __restrict in, float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = weight * in[x];
}

ESI_SIMD void add_both(int cols, float weight, const float* __restrict a, const float* __restrict b,
                       float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] += weight * (a[x] + b[x]);
}

/// gfedcb|abcdefgh|gfedcba, however small the image is.
int mirrored(int i, int size) { return cv::borderInterpolate(i, size, cv::BORDER_REFLECT_101); }

}  // namespace

Gaussian::Gaussian(double deviation_px)
    : reach_px_(std::max(1, static_cast<int>(std::ceil(kReach * deviation_px)))),
      half_(half_kernel(deviation_px, reach_px_)) {}

void Gaussian::apply(cv::Mat1f& image, const RowTeam& team) {
  rows_.create(image.rows, image.cols);
  team.over_rows(image.size(), [&](int begin, int end) { blur_along_rows(image, begin, end); });
  team.over_rows(image.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) blur_across_rows(y, image[y]);
  });
}

void Gaussian::blur_across_rows(int y, float* out) const {
  scale(rows_.cols, half_[0], rows_[y], out);
  for (int i = 1; i <= reach_px_; ++i) {
    const float weight = half_[static_cast<std::size_t>(i)];
    const float* const above = rows_[mirrored(y - i, rows_.rows)];
    const float* const below = rows_[mirrored(y + i, rows_.rows)];
    add_both(rows_.cols, weight, above, below, out);
  }
}

void Gaussian::blur_along_rows(const cv::Mat1f& image, int begin, int end) {
  const int cols = image.cols;
  std::vector<float> padded(static_cast<std::size_t>(cols) + 2 * static_cast<std::size_t>(reach_px_));
  float* const line = padded.data() + reach_px_;
  for (int y = begin; y < end; ++y) {
    std::copy_n(image[y], cols, line);
    for (int i = 1; i <= reach_px_; ++i) {
      line[-i] = image(y, mirrored(-i, cols));
      line[cols - 1 + i] = image(y, mirrored(cols - 1 + i, cols));
    }
    float* const out = rows_[y];
    scale(cols, half_[0], line, out);
    for (int i = 1; i <= reach_px_; ++i) {
      const float weight = half_[static_cast<std::size_t>(i)];
      add_both(cols, weight, line - i, line + i, out);
    }
  }
}

}  // namespace esi
