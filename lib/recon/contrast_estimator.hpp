#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace esi {

/// The contrast threshold c that a recording's own intensity frames and events agree on: where the logarithm
/// of a pixel changed by D and its sum of events by A, D = c A. The estimate is the median of all D / A seen
/// so far, each of weight |A|: the c that makes the sum of |D - c A| least. Unlike least squares it isn't
/// ruled by the few pixels that fire without end.
class ContrastEstimator {
 public:
  ContrastEstimator();

  /// Takes one more pair of frames: log_change and event_change hold D and A, and `is_usable` is 0 where a
  /// pixel shall not count (under- or overexposed).
  void add(const cv::Mat1f& log_change, const cv::Mat1f& event_change, const cv::Mat1b& is_usable);

  /// Nothing until enough pixels have been seen, and where frames and events don't go together.
  std::optional<double> contrast() const { return contrast_; }

 private:
  std::optional<double> median() const;

  std::vector<double> weights_;  ///< of the ratios D / A > 0, in cells of kCell
  double positive_ = 0.0;        ///< their sum
  double negative_ = 0.0;        ///< weight of the ratios <= 0
  std::int64_t pixels_ = 0;
  std::optional<double> contrast_;
};

}  // namespace esi
