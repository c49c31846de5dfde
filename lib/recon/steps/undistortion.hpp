#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "esi/core/camera_calibration.hpp"

namespace esi {

/// Where a point (x, y) = (X/Z, Y/Z) of a scene falls in the lens's image plane.
cv::Point2d distorted(const CameraCalibration& camera, cv::Point2d point);

/// Makes images as a pinhole camera of the same fx, fy, cx and cy takes them. What lies outside the sensor is
/// black.
class Undistortion {
 public:
  /// `size` is that of the images, whose corner is the calibrated sensor's pixel `corner`.
  Undistortion(const CameraCalibration& camera, SensorSize size, cv::Point corner = {});

  /// Bilinear.
  void apply(cv::Mat1f& levels);

 private:
  cv::Mat2f source_px_;  ///< of every pixel
  cv::Mat1f straight_;
};

}  // namespace esi
