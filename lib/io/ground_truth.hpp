#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/phase.hpp"
#include "esi/core/truth.hpp"

namespace esi {

/// What is known of a recording from elsewhere. Only phases are always there. Times are on the recording's
/// clock. Format: docs/formats.md, "Ground truth".
struct GroundTruth {
  std::vector<Phase> phases;  ///< by time, without overlap, none empty
  std::optional<TrueTags> tags;
  std::optional<CameraModel> camera;
  /// Files beside it, as paths that can be opened; empty where not given.
  std::filesystem::path corners, target_poses, camera_poses, clean_frames;
};

/// Throws a usage Error "FILE: what, where" for text that is no such JSON, unknown keys, values that can't
/// be.
GroundTruth read_ground_truth(const std::filesystem::path& path);

/// The same for text; `path` names it and is what its files' paths are relative to.
GroundTruth parse_ground_truth(std::string_view text, const std::filesystem::path& path);

/// Throws a usage Error that shows both where none of the phases has any part of the recording in it, and
/// asks for the unit where that would explain it. Of a whole recording also where phases that begin with it
/// last some 1000 times as long.
void require_overlap(const GroundTruth& truth, Interval recording, bool is_whole, const std::string& name);

}  // namespace esi
