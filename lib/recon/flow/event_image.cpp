#include "esi/recon/flow/event_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace esi {
namespace {

/// Counts are halved here: seconds to minutes of events, so that a ratio that changes is followed.
constexpr double kCountCap = 1 << 22;
/// Both counts begin with so many, so that the first windows' ratio isn't taken at its word.
constexpr double kPrior = 1000.0;
/// Beyond it polarity means nothing.
constexpr double kLargestRatio = 16.0;

}  // namespace

EventImage::EventImage(SensorSize size, bool balance)
    : balance_(balance), image_(size.height_px, size.width_px, 0.0F) {}

const cv::Mat1f& EventImage::of(std::span<const Event> window, std::span<const float> weights) {
  const double ratio = std::clamp((off_ + kPrior) / (on_ + kPrior), 1.0 / kLargestRatio, kLargestRatio);
  const double on = balance_ ? std::sqrt(ratio) : 1.0;
  const std::array<float, 2> step{static_cast<float>(-1.0 / on), static_cast<float>(on)};
  image_.setTo(0.0F);
  float* const pixels = image_[0];
  const auto width = static_cast<std::size_t>(image_.cols);
  for (std::size_t i = 0; i < window.size(); ++i) {
    const Event& event = window[i];
    const float weight = weights.empty() ? 1.0F : weights[i];
    pixels[event.y * width + event.x] += weight * step[static_cast<std::size_t>(event.on)];
  }
  count(window);
  return image_;
}

void EventImage::count(std::span<const Event> window) {
  const auto on = std::count_if(window.begin(), window.end(), [](const Event& event) { return event.on; });
  on_ += static_cast<double>(on);
  off_ += static_cast<double>(static_cast<std::ptrdiff_t>(window.size()) - on);
  if (on_ + off_ < kCountCap) return;
  on_ /= 2.0;
  off_ /= 2.0;
}

}  // namespace esi
