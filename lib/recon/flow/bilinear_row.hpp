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
  std::vector<int> shift_;     ///< from a pixel to the upper left of the four around the place
  std::vector<int> run_ends_;  ///< of neighbours that have the same shift: motion is smooth, so they are long
  std::size_t runs_ = 0;
  std::vector<float> right_, below_;  ///< shares of the neighbours
};

}  // namespace esi
