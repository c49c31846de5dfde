#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/core/row_team.hpp"

namespace esi {

/// A Gaussian over an image that is mirrored at its border pixels. In place of OpenCV's, whose last bit
/// depends on a pixel's column and on the machine.
class Gaussian {
 public:
  /// Cut off at `reach_px` = 3 deviations, rounded up: 0.3 % of it lie beyond.
  explicit Gaussian(double deviation_px);

  void apply(cv::Mat1f& image, const RowTeam& team = kAlone);

 private:
  void blur_along_rows(const cv::Mat1f& image, int begin, int end);
  void blur_across_rows(int y, float* out) const;

  int reach_px_;
  std::vector<float> half_;  ///< the kernel's weights from its middle outwards
  cv::Mat1f rows_;           ///< blurred along x
};

}  // namespace esi
