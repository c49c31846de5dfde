#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/core/pose.hpp"
#include "esi/core/truth.hpp"

namespace esi {

/// Where a body is at any time: between the poses of a TUM track position on a straight line, rotation at
/// constant speed about one axis (slerp).
class PoseTrack {
 public:
  /// Throws a usage Error where times don't ascend. There is nothing to say between poses that are more than
  /// `longest_gap_us` apart.
  explicit PoseTrack(std::vector<TrackPose> poses, std::int64_t longest_gap_us = 100'000);

  /// Nothing before the first pose, after the last one, and in gaps.
  std::optional<Pose> at(std::int64_t t_us) const;

 private:
  std::vector<TrackPose> poses_;
  std::int64_t longest_gap_us_;
};

/// How far a UAV is wrong about where it is: deviations per axis, of errors that fade with the correlation
/// time (first-order Gauss-Markov; 0 for errors that are new with each pose).
struct PoseNoise {
  double position_m = 0.02;
  double angle_deg = 0.3;
  double correlation_s = 1.0;
  std::int64_t seed = 1;

  void declare(OptionTable& table);
};

/// The same track as such a UAV would tell it. Same noise and track, same poses.
std::vector<TrackPose> with_noise(std::vector<TrackPose> poses, const PoseNoise& noise);

}  // namespace esi
