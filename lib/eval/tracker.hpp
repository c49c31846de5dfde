#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <optional>

#include "esi/core/options.hpp"
#include "esi/core/pose.hpp"
#include "esi/core/truth.hpp"

namespace esi {

/// All noises are standard deviations.
struct TrackerOptions {
  double acceleration_noise = 2.0;  ///< m/s^1.5: root of the white acceleration's spectral density
  double pixel_noise_px = 2.0;
  double side_noise_px = 1.0;
  double own_position_noise_m = 0.02;
  double first_speed_noise_m_s = 3.0;
  double gate = 11.34;
  std::int64_t gated_in_a_row = 10;
  double longest_gap_s = 2.0;

  void declare(OptionTable& table);
};

/// The target seen from the camera: the target's image in a pinhole without distortion, and its depth.
struct TargetMeasurement {
  double u_px = 0.0, v_px = 0.0, depth_m = 0.0;
  double depth_noise_m = 0.0;  ///< deviation
};

struct TargetState {
  std::int64_t t_us = 0;
  cv::Vec3d position_m, velocity_m_s;  ///< in the world
  cv::Matx66d covariance;              ///< position, velocity
};

/// Image and depth of a point of the world, and their derivative by the point. Nothing behind the camera.
struct Projection {
  cv::Vec3d uvd;  ///< px, px, m
  cv::Matx33d jacobian;
};
std::optional<Projection> project(const cv::Vec3d& world_m, const Pose& camera_pose,
                                  const CameraModel& camera);
/// The point of the world with that image and depth.
cv::Vec3d unproject(const cv::Vec3d& uvd, const Pose& camera_pose, const CameraModel& camera);

/// The state after `dt_s` of constant velocity, disturbed by white acceleration.
TargetState predicted(const TargetState& state, std::int64_t t_us, double acceleration_noise);

/// Extended Kalman filter of the target's position and velocity in the world. It only follows positions:
/// the rotation of a tag seen frontally is often the mirrored one.
class Tracker {
 public:
  enum class Outcome { started, used, gated };

  Tracker(const TrackerOptions& options, const CameraModel& camera);

  /// A measurement at a time that isn't before the last one's (else a usage Error), from a camera that was
  /// there. Starts anew after the longest gap, and when too many in a row were gated.
  Outcome update(std::int64_t t_us, const TargetMeasurement& measurement, const Pose& camera_pose);

  /// Predicted from the last measurement used. Nothing before the first, and after the longest gap.
  std::optional<TargetState> at(std::int64_t t_us) const;

 private:
  void start(std::int64_t t_us, const TargetMeasurement& measurement, const Pose& camera_pose);
  cv::Matx33d noise_of(const TargetMeasurement& measurement, const cv::Matx33d& jacobian) const;

  TrackerOptions options_;
  CameraModel camera_;
  std::optional<TargetState> state_;
  std::int64_t latest_us_ = 0;
  std::int64_t gated_in_a_row_ = 0;
};

}  // namespace esi
