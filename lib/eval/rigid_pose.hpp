#pragma once

#include <array>
#include <opencv2/core/matx.hpp>

namespace esi {

/// Takes points of a body's frame to the frame it is given in, in metres. Camera: x right, y down, z forward.
/// Tag and target: x right and y down as a tag is read, hence z away from who reads it. World: z up.
struct RigidPose {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d position_m;

  cv::Vec3d operator*(const cv::Vec3d& point_m) const { return rotation * point_m + position_m; }
  RigidPose operator*(const RigidPose& other) const {
    return {rotation * other.rotation, *this * other.position_m};
  }
  RigidPose inverse() const { return {rotation.t(), -(rotation.t() * position_m)}; }
};

/// Of any length but 0.
cv::Matx33d rotation_of_quaternion(const std::array<double, 4>& xyzw);

}  // namespace esi
