#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace esi {

/// Square cells over an image, from its upper left corner on, the last ones cut off by its border. A value
/// per cell stands at the cell's centre; between centres values are interpolated bilinearly, and outside them
/// the nearest go on.
class CellGrid {
 public:
  CellGrid(cv::Size image, double cell_px);

  /// Of the grid, in cells.
  cv::Size size() const { return {cols_, rows_}; }

  /// The cell that pixel row y, or pixel column x, lies in.
  int cell_of(int pixel) const { return static_cast<int>((pixel + 0.5) / cell_px_); }

  /// A row of the image's pixels: `scale` times the interpolated values.
  void interpolate_row(const cv::Mat1f& cells, int y, float scale, float* out);

 private:
  double cell_px_;
  int cols_, rows_;
  /// Where pixel columns begin that lie between the same two entries of line_, and the image's width.
  std::vector<int> begins_;
  std::vector<float> share_;  ///< of each pixel column: how near it is to the entry right of it
  std::vector<float> line_;   ///< one row of cells, the first and the last of them twice
};

}  // namespace esi
