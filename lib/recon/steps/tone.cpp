#include "esi/recon/steps/tone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr float kLeastSpread = 1.0F;  // grey levels

}  // namespace

void SmoothingOptions::declare(OptionTable& table) {
  table.toggle("median", median, "replace each grey level by the median of 3x3 pixels");
  table.real("blur_px", blur_px, {0.0, 20.0}, "px", "deviation of a Gaussian over the grey levels; 0: none");
}

Smoothing::Smoothing(const SmoothingOptions& options) : median_(options.median) {
  if (options.blur_px > 0.0) gaussian_.emplace(options.blur_px);
}

void Smoothing::apply(cv::Mat1f& levels) {
  if (median_) {
    cv::medianBlur(levels, medians_, 3);
    cv::swap(levels, medians_);
  }
  if (gaussian_) gaussian_->apply(levels);
}

void RangeOptions::declare(OptionTable& table) {
  table.choice("range", range, {"fixed", "percentile"},
               "what is shown black and white: the method's bounds, or percentiles of each frame");
  table.real("low_percent", low_percent, {0.0, 100.0}, "%", "this share of the pixels is darker than black");
  table.real("high_percent", high_percent, {0.0, 100.0}, "%", "this share is darker than white");
}

void RangeOptions::check() const {
  if (low_percent < high_percent) return;
  throw usage_error(
      fmt::format("low_percent {} must be smaller than high_percent {}", low_percent, high_percent));
}

void RangeStretch::apply(cv::Mat1f& levels) {
  if (options_.range == Range::fixed) return;
  sorted_.assign(levels.begin(), levels.end());
  const float low = percentile(options_.low_percent);
  const float high = percentile(options_.high_percent);
  if (high - low < kLeastSpread) return;
  const float scale = 255.0F / (high - low);
  for (float& level : levels) level = (level - low) * scale;
}

float RangeStretch::percentile(double percent) {
  const double rank = std::round(percent / 100.0 * static_cast<double>(sorted_.size() - 1));
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  return *middle;
}

}  // namespace esi
