#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/sim/pose.hpp"

namespace esi {

/// Reads TUM lines "t tx ty tz qx qy qz qw": seconds, metres, blanks between; `#` comments and empty lines
/// are skipped. Throws an Error "NAME: ... (line N) ..." on lines of another form, numbers that aren't
/// finite, a quaternion of length 0, times that don't ascend, and when there is no pose at all.
std::vector<TimedPose> parse_tum_poses(std::string_view text, const std::string& name);

}  // namespace esi
