#pragma once

#include <opencv2/core/mat.hpp>

namespace esi {

/// [1 2 1] / 4 along both axes, the border going on outside. In place of OpenCV's filters, whose last bit
/// depends on the machine.
void smooth_cells(cv::Mat1f& cells);

/// The mean of the four neighbours, the border going on outside.
cv::Mat1f mean_of_neighbours(const cv::Mat1f& cells);

}  // namespace esi
