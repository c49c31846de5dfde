#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/phase.hpp"

namespace esi {

/// The AprilTags that can be seen.
struct TrueTags {
  std::string family;
  std::vector<int> ids;          ///< each once
  std::map<int, double> size_m;  ///< edge of the black square; not every id need have one
};

/// Pinhole camera. Pixel centres are at whole numbers.
struct CameraModel {
  int width_px = 0, height_px = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  std::vector<double> distortion;         ///< OpenCV's k1, k2, p1, p2, k3, ...; may be empty
};

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
/// asks for the unit where that would explain it.
void require_overlap(const GroundTruth& truth, Interval recording, const std::string& name);

}  // namespace esi
