#include "esi/recon/network_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace esi {
namespace {

constexpr int kKernel_px = 5;
constexpr double kKernelReach = 1.3;  ///< in deviations: sigma 1 and half of an interval of (2 + 1) / 5

/// The share of a normal distribution below x deviations.
double normal_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

cv::Mat1f unsharp_kernel() {
  cv::Mat1f kernel(kKernel_px, 1);
  const double step = 2.0 * kKernelReach / kKernel_px;
  for (int i = 0; i < kKernel_px; ++i) {
    const double left = -kKernelReach + i * step;
    kernel(i) = static_cast<float>(std::sqrt(normal_below(left + step) - normal_below(left)));
  }
  kernel *= 1.0 / cv::sum(kernel)[0];
  return kernel;
}

int up_to_multiple(int length_px, int multiple_px) {
  return (multiple_px - length_px % multiple_px) % multiple_px;
}

}  // namespace

Padding Padding::to_multiple(SensorSize size, int multiple_px) {
  const int rows = up_to_multiple(size.height_px, multiple_px);
  const int columns = up_to_multiple(size.width_px, multiple_px);
  return {rows - rows / 2, rows / 2, columns - columns / 2, columns / 2};
}

void pad_reflected(const cv::Mat& grid, const Padding& padding, cv::Mat& padded) {
  const int rows = grid.size[2] + padding.top + padding.bottom;
  const int columns = grid.size[3] + padding.left + padding.right;
  const std::array<int, 4> shape{1, grid.size[1], rows, columns};
  padded.create(4, shape.data(), CV_32F);
  for (int channel = 0; channel < grid.size[1]; ++channel) {
    const cv::Mat from(grid.size[2], grid.size[3], CV_32F, const_cast<float*>(grid.ptr<float>(0, channel)));
    const cv::Mat to(rows, columns, CV_32F, padded.ptr<float>(0, channel));
    cv::copyMakeBorder(from, to, padding.top, padding.bottom, padding.left, padding.right,
                       cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  }
}

cv::Mat1f unsharp(const cv::Mat1f& image, double amount) {
  const cv::Mat1f kernel = unsharp_kernel();
  cv::Mat1f blurred;
  cv::sepFilter2D(image, blurred, CV_32F, kernel, kernel, {-1, -1}, 0.0, cv::BORDER_CONSTANT);
  cv::Mat1f sharp;
  cv::addWeighted(image, 1.0 + amount, blurred, -amount, 0.0, sharp);
  return sharp;
}

cv::Mat1f without_padding(const cv::Mat1f& image, const Padding& padding) {
  return image.rowRange(padding.top, image.rows - padding.bottom)
      .colRange(padding.left, image.cols - padding.right);
}

void levels_between(const cv::Mat1f& image, float low, float high, cv::Mat1f& levels) {
  const double scale = high > low ? 255.0 / (static_cast<double>(high) - static_cast<double>(low)) : 0.0;
  image.convertTo(levels, CV_32F, scale, scale > 0.0 ? -scale * static_cast<double>(low) : kMidGrey);
}

float percentile(const cv::Mat1f& image, double percent) {
  std::vector<float> values(image.begin(), image.end());
  const double place = percent / 100.0 * static_cast<double>(values.size() - 1);
  const auto lower = static_cast<std::size_t>(place);
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(values.begin(), at(lower), values.end());
  const auto low = static_cast<double>(values[lower]);
  if (lower + 1 == values.size()) return static_cast<float>(low);
  const auto high = static_cast<double>(*std::min_element(at(lower + 1), values.end()));
  return static_cast<float>(low + (high - low) * (place - static_cast<double>(lower)));
}

}  // namespace esi
