#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/recon/steps/gaussian.hpp"

// Steps after a method, on its grey levels before they are rounded.

namespace esi {

/// Noise of single pixels taken out of an image.
struct SmoothingOptions {
  bool median = false;   ///< of 3x3 pixels
  double blur_px = 0.0;  ///< deviation of a Gaussian, after the median; 0: off

  void declare(OptionTable& table);
  bool any() const { return median || blur_px > 0.0; }
};

/// Outside the image the border goes on for the median, and is mirrored for the Gaussian.
class Smoothing {
 public:
  explicit Smoothing(const SmoothingOptions& options);
  void apply(cv::Mat1f& levels);

 private:
  bool median_;
  cv::Mat1f medians_;
  std::optional<Gaussian> gaussian_;
};

enum class Range {
  fixed,       ///< as the method gives them
  percentile,  ///< two shares of the pixels' levels become 0 and 255
};

struct RangeOptions {
  Range range = Range::fixed;
  double low_percent = 1.0;
  double high_percent = 99.0;

  void declare(OptionTable& table);
  /// Throws a usage Error unless low < high.
  void check() const;
};

/// Stretches levels linearly. Where the two percentiles are less than one grey level apart there is nothing
/// to see, and the image stays as it is.
class RangeStretch {
 public:
  explicit RangeStretch(const RangeOptions& options) : options_(options) { options.check(); }
  void apply(cv::Mat1f& levels);

 private:
  /// The level at round(percent/100 (n - 1)) of the n sorted levels.
  float percentile(double percent);

  RangeOptions options_;
  std::vector<float> sorted_;  ///< in part
};

}  // namespace esi
