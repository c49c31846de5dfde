#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <span>

namespace esi {

/// Unit quaternion in the order of TUM lines.
struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

Quaternion quaternion_of(const cv::Matx33d& rotation);
cv::Matx33d rotation_of(const Quaternion& unit);

/// The rotation by |v| radians about v.
cv::Matx33d rotation_about(const cv::Vec3d& v);

/// Where a body is: takes points of the body's frame to the world's (metres, z up).
struct Pose {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d position;

  cv::Vec3d operator*(const cv::Vec3d& point) const { return rotation * point + position; }
  Pose operator*(const Pose& other) const { return {rotation * other.rotation, *this * other.position}; }
  Pose inverse() const { return {rotation.t(), -(rotation.t() * position)}; }
};

struct TimedPose {
  std::int64_t t_us = 0;
  Pose pose;
};

/// The pose at a time between those of the list (ascending, not empty): position on a straight line, rotation
/// at constant speed about one axis. Before the first and after the last it stays.
Pose interpolate(std::span<const TimedPose> poses, std::int64_t t_us);

}  // namespace esi
