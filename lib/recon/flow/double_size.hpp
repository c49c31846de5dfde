#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace esi {

/// Twice the resolution, bilinearly; outside, the border goes on.
class DoubleSize {
 public:
  explicit DoubleSize(const cv::Mat1f& coarse);

  /// Row y of the result. `cols` is twice the coarse columns, or one less.
  void row(int y, int cols, float* out);

 private:
  const cv::Mat1f& coarse_;
  std::vector<float> line_;  ///< between two rows; the first and the last entry are there twice
};

}  // namespace esi
