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

using Quaternion = cv::Vec4d;  // x, y, z, w

Quaternion unit_quaternion(const std::array<double, 4>& xyzw) {
  const Quaternion q(xyzw[0], xyzw[1], xyzw[2], xyzw[3]);
  return q / cv::norm(q);
}

/// a, then b's rotation before it: the rotation a * b.
Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Quaternion slerp(const Quaternion& a, Quaternion b, double share) {
  double cosine = a.dot(b);
  if (cosine < 0.0) {  // b and -b are the same rotation, this one is nearer
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 0.9999) return cv::normalize(a * (1.0 - share) + b * share);
  const double angle = std::acos(cosine);
  return (a * std::sin((1.0 - share) * angle) + b * std::sin(share * angle)) / std::sin(angle);
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

Quaternion rotation_by(const cv::Vec3d& angles_rad) {
  const double angle = cv::norm(angles_rad);
  if (angle == 0.0) return {0.0, 0.0, 0.0, 1.0};
  const cv::Vec3d v = angles_rad * (std::sin(angle / 2.0) / angle);
  return {v[0], v[1], v[2], std::cos(angle / 2.0)};
}

}  // namespace

cv::Matx33d rotation_of_quaternion(const std::array<double, 4>& xyzw) {
  const auto q = unit_quaternion(xyzw);
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
          2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
          2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
}

PoseTrack::PoseTrack(std::vector<TrackPose> poses, std::int64_t longest_gap_us)
    : poses_(std::move(poses)), longest_gap_us_(longest_gap_us) {
  const auto clash = std::adjacent_find(
      poses_.begin(), poses_.end(), [](const TrackPose& a, const TrackPose& b) { return b.t_us <= a.t_us; });
  if (clash == poses_.end()) return;
  throw usage_error(fmt::format("the pose after {} s is not later", seconds_text(clash->t_us)));
}

std::optional<RigidPose> PoseTrack::at(std::int64_t t_us) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), t_us,
                                      [](const TrackPose& pose, std::int64_t t) { return pose.t_us < t; });
  if (after == poses_.end()) return std::nullopt;
  const cv::Vec3d end(after->position_m.data());
  if (after->t_us == t_us) return RigidPose{rotation_of_quaternion(after->quaternion_xyzw), end};
  if (after == poses_.begin()) return std::nullopt;
  const auto before = after - 1;
  const std::int64_t gap_us = after->t_us - before->t_us;
  if (gap_us > longest_gap_us_) return std::nullopt;
  const double share = static_cast<double>(t_us - before->t_us) / static_cast<double>(gap_us);
  const cv::Vec3d begin(before->position_m.data());
  const Quaternion q =
      slerp(unit_quaternion(before->quaternion_xyzw), unit_quaternion(after->quaternion_xyzw), share);
  return RigidPose{rotation_of_quaternion({q[0], q[1], q[2], q[3]}), begin + share * (end - begin)};
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
    const Quaternion turned =
        product(unit_quaternion(pose.quaternion_xyzw),
                rotation_by(angle_error * (noise.angle_deg * std::numbers::pi / 180.0)));
    pose.quaternion_xyzw = {turned[0], turned[1], turned[2], turned[3]};
  }
  return poses;
}

}  // namespace esi
