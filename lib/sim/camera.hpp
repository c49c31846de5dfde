#pragma once

#include <opencv2/core/matx.hpp>
#include <string>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"

namespace esi {

/// The sensor and its lens. A DAVIS346 unless told otherwise.
struct CameraOptions {
  std::string sensor = "346x260";
  double fov_deg = 80.0;  ///< horizontal, of the whole sensor
  double scale = 1.0;
  std::string crop = {};  ///< WIDTHxHEIGHT, or empty for the whole sensor

  void declare(OptionTable& table);
};

/// A pinhole camera without distortion: x right, y down, z forward; pixel centres at integers.
struct Camera {
  SensorSize size;
  double focal_px = 0.0;
  cv::Vec2d centre_px;  ///< principal point
  cv::Vec2i origin_px;  ///< of the crop, in the whole sensor

  /// Throws a usage Error where the crop isn't inside the scaled sensor.
  explicit Camera(const CameraOptions& options);

  cv::Matx33d matrix() const {
    return {focal_px, 0.0, centre_px[0], 0.0, focal_px, centre_px[1], 0.0, 0.0, 1.0};
  }

  /// Image of a point of the camera's frame with z > 0.
  cv::Vec2d project(const cv::Vec3d& point) const {
    return {centre_px[0] + focal_px * point[0] / point[2], centre_px[1] + focal_px * point[1] / point[2]};
  }

  /// Whether a point lies on the sensor's pixels, which reach half a pixel beyond the outer centres.
  bool sees(const cv::Vec2d& point_px) const {
    return point_px[0] >= -0.5 && point_px[1] >= -0.5 && point_px[0] < size.width_px - 0.5 &&
           point_px[1] < size.height_px - 0.5;
  }
};

}  // namespace esi
