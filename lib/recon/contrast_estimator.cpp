#include "esi/recon/contrast_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace esi {
namespace {

/// Fewer events are mostly chance: where in its threshold a pixel began.
constexpr float kLeastEvents = 3.0F;
constexpr std::int64_t kLeastPixels = 100;
/// Were frames and events of different scenes, half of the weight would have the right sign.
constexpr double kLeastAgreement = 0.7;

constexpr double kCell = 0.0005;      ///< c is told this finely, and finer by interpolation
constexpr std::size_t kCells = 4000;  ///< up to c = 2; larger ratios lie in one last cell

}  // namespace

ContrastEstimator::ContrastEstimator() : weights_(kCells + 1) {}

void ContrastEstimator::add(const cv::Mat1f& log_change, const cv::Mat1f& event_change,
                            const cv::Mat1b& is_usable) {
  for (int y = 0; y < log_change.rows; ++y) {
    for (int x = 0; x < log_change.cols; ++x) {
      const float events = event_change(y, x);
      if (is_usable(y, x) == 0 || std::abs(events) < kLeastEvents) continue;
      const auto weight = static_cast<double>(std::abs(events));
      const auto ratio = static_cast<double>(log_change(y, x) / events);
      ++pixels_;
      (ratio > 0.0 ? positive_ : negative_) += weight;
      if (ratio > 0.0) weights_[static_cast<std::size_t>(std::min(ratio / kCell, double{kCells}))] += weight;
    }
  }
  contrast_ = median();
}

std::optional<double> ContrastEstimator::median() const {
  const double all = positive_ + negative_;
  if (pixels_ < kLeastPixels || positive_ < kLeastAgreement * all) return std::nullopt;
  double below = negative_;
  for (std::size_t i = 0; i < kCells; ++i) {
    if (below + weights_[i] < all / 2.0) {
      below += weights_[i];
      continue;
    }
    return (static_cast<double>(i) + (all / 2.0 - below) / weights_[i]) * kCell;
  }
  return std::nullopt;  // no camera's threshold
}

}  // namespace esi
