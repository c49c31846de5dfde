#pragma once

#include <vector>

#include "esi/core/event.hpp"

namespace esi {

enum class LensModel {
  radial_tangential,  ///< k1, k2, p1, p2, k3 and, for a rational model, k4, k5, k6 (Brown; OpenCV's order)
  equidistant,        ///< k1 to k4 (Kannala and Brandt; OpenCV's fisheye)
};

/// A pinhole camera with a lens, as a calibration tool found it. Pixel centres are at whole numbers.
struct CameraCalibration {
  SensorSize size;                        ///< 0x0 where the file doesn't say
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  LensModel model = LensModel::radial_tangential;
  std::vector<double> distortion;  ///< may be empty, or shorter than the model's list: the rest is 0
};

}  // namespace esi
