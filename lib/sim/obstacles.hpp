#pragma once

#include <cstdint>
#include <vector>

#include "esi/sim/box.hpp"
#include "esi/sim/trajectory.hpp"

namespace esi {

/// Up to `count` boxes beside the vehicle's way, clear of it and of one another. Fewer where there is no
/// room.
std::vector<Box> place_obstacles(std::int64_t count, const Trajectory& trajectory, std::int64_t seed);

}  // namespace esi
