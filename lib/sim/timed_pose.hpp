#pragma once

#include <cstdint>
#include <span>

#include "esi/core/pose.hpp"

namespace esi {

struct TimedPose {
  std::int64_t t_us = 0;
  Pose pose;
};

/// The pose at a time between those of the list (ascending, not empty): position on a straight line, rotation
/// at constant speed about one axis. Before the first and after the last it stays.
Pose interpolate(std::span<const TimedPose> poses, std::int64_t t_us);

}  // namespace esi
