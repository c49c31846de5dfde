#pragma once

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "esi/core/pose.hpp"
#include "esi/core/truth.hpp"

namespace esi::test {

inline const CameraModel kCamera{346, 260, 206.0, 206.0, 172.5, 129.5, {}};

/// By OpenCV, not by the code under test.
inline cv::Matx33d rodrigues(const cv::Vec3d& v) {
  cv::Matx33d rotation;
  cv::Rodrigues(v, rotation);
  return rotation;
}

/// A pose of the camera's frame as a line of a track.
inline TrackPose track_pose(std::int64_t t_us, const Pose& pose) {
  cv::Vec3d v;
  cv::Rodrigues(pose.rotation, v);
  const double angle = cv::norm(v), factor = angle > 0.0 ? std::sin(angle / 2.0) / angle : 0.0;
  const cv::Vec3d& p = pose.position_m;
  return {t_us, {p[0], p[1], p[2]}, {v[0] * factor, v[1] * factor, v[2] * factor, std::cos(angle / 2.0)}};
}

/// Where OpenCV projects the corners of a tag in the camera's frame to: lower left, lower right, upper right,
/// upper left in the tag's own frame of x right and y down.
inline std::array<double, 8> tag_corners(const Pose& tag, double size_m,
                                         const CameraModel& camera = kCamera) {
  const double h = size_m / 2.0;
  const std::vector<cv::Point3d> corners{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
  const cv::Matx33d matrix{camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  cv::Vec3d rotation;
  cv::Rodrigues(tag.rotation, rotation);
  std::vector<cv::Point2d> points;
  cv::projectPoints(corners, rotation, tag.position_m, matrix, camera.distortion, points);
  std::array<double, 8> xy_px{};
  for (std::size_t k = 0; k < 4; ++k) {
    xy_px[2 * k] = points[k].x;
    xy_px[2 * k + 1] = points[k].y;
  }
  return xy_px;
}

}  // namespace esi::test
