#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/recon/flow/bilinear_row.hpp"
#include "esi/recon/flow/cell_grid.hpp"
#include "esi/recon/flow/common_motion.hpp"

namespace esi {

/// How a row of an image moves, and where its pixels come from. What one thread needs for rows of its own.
struct RowMotion {
  RowMotion(cv::Size size, const CellGrid& over)
      : cells(over), lookup(size), x(static_cast<std::size_t>(size.width)), y(x.size()) {}

  /// x and y become `share` of the motion in this row, and pixels are looked up where they were before it.
  void look_up(const MotionField& field, int row, float share) {
    cells.interpolate_row(field.x, row, share, x.data());
    cells.interpolate_row(field.y, row, share, y.data());
    lookup.place(row, x.data(), y.data(), 1.0F);
  }

  CellGrid cells;
  BilinearRow lookup;
  std::vector<float> x, y;
};

}  // namespace esi
