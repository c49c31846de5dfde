#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace esi {

/// Least squares for the motion of each cell, from there on where it stands: xx, xy, yy of T, then x and y of
/// rhs, equation (3). All of one size.
using CellSums = std::array<cv::Mat1f, 5>;

/// The image's motion: one vector per cell, in px of the full resolution per window.
struct MotionField {
  cv::Mat1f x, y;
};

/// Adds one affine motion to all cells, the best for them together:
///   v += p + P x,   (p, P) = argmin sum d^T T d - 2 d . rhs + |p|^2 + |P|^2,   d = p + P x       (2)
/// x is 0 in the grid's middle and goes from -1 to 1 over its width (of three columns or more); y has the
/// same unit. Most of what changes from window to window is the camera's turning, which all cells share.
void add_common_motion(const CellSums& sums, MotionField& field);

}  // namespace esi
