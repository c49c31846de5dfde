#pragma once

#include <opencv2/core/mat.hpp>

namespace esi {

/// Floats in the widest vector of a processor that we compile for.
constexpr int kVectorFloats = 16;

inline int padded(int cols) { return (cols + kVectorFloats - 1) / kVectorFloats * kVectorFloats; }

/// An image of zeros whose rows begin padded(cols) floats apart. A row may be worked on to its padded end,
/// which stays 0 where every operand's does: loops over it have no rest.
inline cv::Mat1f padded_plane(cv::Size size) {
  return cv::Mat1f(size.height, padded(size.width), 0.0F).colRange(0, size.width);
}

}  // namespace esi
