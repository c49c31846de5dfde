#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace esi {

/// Looks a row of pixels up elsewhere in images of one size, between pixels bilinearly. Beyond the border the
/// border pixels go on.
class BilinearRow {
 public:
  explicit BilinearRow(cv::Size size);

  /// From now on pixel x of row y is looked up at (x, y) + offset (1, 1) - scale (vx[x], vy[x]), in px; v has
  /// as many entries as there are columns.
  void place(int y, const float* vx, const float* vy, float scale, float offset = 0.0F);

  /// `image` is continuous.
  void sample(const cv::Mat1f& image, float* out) const;

 private:
  cv::Size size_;
  std::vector<int> index_;            ///< of the upper left of the four pixels around
  std::vector<float> right_, below_;  ///< shares of the neighbours
};

}  // namespace esi
