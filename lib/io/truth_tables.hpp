#pragma once

#include <filesystem>
#include <vector>

#include "esi/core/truth.hpp"

namespace esi {

/// Reads corners.csv (docs/formats.md, "Ground truth"): a header line with the columns' names, then rows
/// whose times don't go back, each tag at most once at a time. Throws a usage Error "FILE: line N: what, what
/// to do", also for numbers that aren't finite and where there are no rows. Empty lines and `#` comments are
/// skipped.
std::vector<TrueCorners> read_corners(const std::filesystem::path& path);

/// Reads TUM lines "t tx ty tz qx qy qz qw": seconds, metres, blanks between. Errors as above, also for times
/// that don't ascend and quaternions of length 0; others are returned as they stand, of any length.
std::vector<TrackPose> read_track(const std::filesystem::path& path);

}  // namespace esi
