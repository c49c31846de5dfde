#include "esi/eval/pose_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {
namespace {

Quaternion quaternion_of(const TrackPose& pose) {
  const auto& [x, y, z, w] = pose.quaternion_xyzw;
  return normalized({x, y, z, w});
}

/// std::normal_distribution differs from library to library; Box and Muller's is the same everywhere.
class NormalSource {
 public:
  explicit NormalSource(std::int64_t seed) : random_(static_cast<std::uint64_t>(seed)) {}

  double next() {
    const double u = (static_cast<double>(random_() >> 11) + 1.0) * 0x1p-53;  // (0, 1]
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(random_() >> 11) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
  }
  cv::Vec3d next_vector() {
    cv::Vec3d v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = next();
    return v;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

PoseTrack::PoseTrack(std::vector<TrackPose> poses, std::int64_t longest_gap_us)
    : poses_(std::move(poses)), longest_gap_us_(longest_gap_us) {
  const auto clash = std::adjacent_find(
      poses_.begin(), poses_.end(), [](const TrackPose& a, const TrackPose& b) { return b.t_us <= a.t_us; });
  if (clash == poses_.end()) return;
  throw usage_error(fmt::format("the pose after {} s is not later", seconds_text(clash->t_us)));
}

std::optional<Pose> PoseTrack::at(std::int64_t t_us) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), t_us,
                                      [](const TrackPose& pose, std::int64_t t) { return pose.t_us < t; });
  if (after == poses_.end()) return std::nullopt;
  const cv::Vec3d end(after->position_m.data());
  if (after->t_us == t_us) return Pose{rotation_of(quaternion_of(*after)), end};
  if (after == poses_.begin()) return std::nullopt;
  const auto before = after - 1;
  const std::int64_t gap_us = after->t_us - before->t_us;
  if (gap_us > longest_gap_us_) return std::nullopt;
  const double share = static_cast<double>(t_us - before->t_us) / static_cast<double>(gap_us);
  const cv::Vec3d begin(before->position_m.data());
  const Quaternion q = slerp(quaternion_of(*before), quaternion_of(*after), share);
  return Pose{rotation_of(q), begin + share * (end - begin)};
}

void PoseNoise::declare(OptionTable& table) {
  table.real("own_position_error", position_m, {0.0, 100.0}, "m",
             "deviation per axis of where the UAV believes to be");
  table.real("own_angle_error", angle_deg, {0.0, 90.0}, "deg",
             "deviation per axis of how the UAV believes to be turned");
  table.real("own_error_correlation", correlation_s, {0.0, 3600.0}, "s",
             "time in which these errors fade to 1/e; 0 makes new ones for each pose");
  table.integer("own_error_seed", seed, {0, 1'000'000'000}, "", "seed of these errors");
}

std::vector<TrackPose> with_noise(std::vector<TrackPose> poses, const PoseNoise& noise) {
  NormalSource normal(noise.seed);
  cv::Vec3d position_error, angle_error;  // in deviations
  for (std::size_t i = 0; i < poses.size(); ++i) {
    TrackPose& pose = poses[i];
    double kept = 0.0;
    if (i > 0 && noise.correlation_s > 0.0) {
      kept = std::exp(-static_cast<double>(pose.t_us - poses[i - 1].t_us) / 1e6 / noise.correlation_s);
    }
    const double fresh = std::sqrt(1.0 - kept * kept);
    position_error = kept * position_error + fresh * normal.next_vector();
    angle_error = kept * angle_error + fresh * normal.next_vector();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      pose.position_m[axis] += noise.position_m * position_error[static_cast<int>(axis)];
    }
    const cv::Vec3d error_rad = angle_error * (noise.angle_deg * std::numbers::pi / 180.0);
    const Quaternion turned = product(quaternion_of(pose), quaternion_about(error_rad));
    pose.quaternion_xyzw = {turned.x, turned.y, turned.z, turned.w};
  }
  return poses;
}

}  // namespace esi
