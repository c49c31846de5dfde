#include "esi/recon/flow/cell_smoothing.hpp"

#include <algorithm>

namespace esi {
namespace {

/// One of the neighbours of cell (x, y), the border going on outside.
float beside(const cv::Mat1f& cells, int y, int x) {
  return cells(std::clamp(y, 0, cells.rows - 1), std::clamp(x, 0, cells.cols - 1));
}

}  // namespace

void smooth_cells(cv::Mat1f& cells) {
  cv::Mat1f along_x(cells.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x)
      along_x(y, x) = 0.25F * (beside(cells, y, x - 1) + beside(cells, y, x + 1)) + 0.5F * cells(y, x);
  }
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x)
      cells(y, x) = 0.25F * (beside(along_x, y - 1, x) + beside(along_x, y + 1, x)) + 0.5F * along_x(y, x);
  }
}

cv::Mat1f mean_of_neighbours(const cv::Mat1f& cells) {
  cv::Mat1f mean(cells.size());
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      mean(y, x) = 0.25F * ((beside(cells, y - 1, x) + beside(cells, y + 1, x)) +
                            (beside(cells, y, x - 1) + beside(cells, y, x + 1)));
    }
  }
  return mean;
}

}  // namespace esi
