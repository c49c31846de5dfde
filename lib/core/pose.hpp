#pragma once

#include <opencv2/core/matx.hpp>

namespace esi {

/// A rotation, in the order of TUM lines. Functions that take one want it at unit length.
struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

/// The same rotation at unit length; of any length but 0.
Quaternion normalized(const Quaternion& q);
/// First b's rotation, then a's.
Quaternion product(const Quaternion& a, const Quaternion& b);
/// From a (share 0) to b (1) the shorter way, at constant speed about one axis.
Quaternion slerp(const Quaternion& a, const Quaternion& b, double share);

Quaternion quaternion_of(const cv::Matx33d& rotation);
cv::Matx33d rotation_of(const Quaternion& unit);

/// The rotation by |v| radians about v.
Quaternion quaternion_about(const cv::Vec3d& v);
cv::Matx33d rotation_about(const cv::Vec3d& v);

/// Where a body is: takes points of its frame to the frame it is given in, in metres. World: z up. Camera: x
/// right, y down, z forward. Tag, board and target: x right and y down as a tag is read, hence z away from
/// who reads it.
struct Pose {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d position_m;

  cv::Vec3d operator*(const cv::Vec3d& point_m) const { return rotation * point_m + position_m; }
  Pose operator*(const Pose& other) const { return {rotation * other.rotation, *this * other.position_m}; }
  Pose inverse() const { return {rotation.t(), -(rotation.t() * position_m)}; }
};

}  // namespace esi
