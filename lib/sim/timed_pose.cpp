#include "esi/sim/timed_pose.hpp"

#include <algorithm>

namespace esi {

Pose interpolate(std::span<const TimedPose> poses, std::int64_t t_us) {
  const auto is_before = [t_us](const TimedPose& p) { return p.t_us <= t_us; };
  const auto next = std::partition_point(poses.begin(), poses.end(), is_before);
  if (next == poses.begin()) return poses.front().pose;
  if (next == poses.end()) return poses.back().pose;
  const TimedPose& a = *(next - 1);
  const TimedPose& b = *next;
  const double share = static_cast<double>(t_us - a.t_us) / static_cast<double>(b.t_us - a.t_us);
  const Quaternion q = slerp(quaternion_of(a.pose.rotation), quaternion_of(b.pose.rotation), share);
  return {rotation_of(q), a.pose.position_m + share * (b.pose.position_m - a.pose.position_m)};
}

}  // namespace esi
