#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "esi/eval/corner_track.hpp"
#include "esi/eval/pose_track.hpp"
#include "esi/eval/verdict.hpp"
#include "esi/io/ground_truth.hpp"
#include "esi/pipeline/evaluation/eval_config.hpp"

namespace esi {

/// Ground truth with what its files hold.
struct LoadedTruth {
  GroundTruth truth;
  std::vector<TrueCorners> corner_rows;
  std::optional<CornerTrack> corners;
  std::vector<TrackPose> camera_poses, target_poses;
  std::map<std::int64_t, std::filesystem::path> clean_frames;  ///< by time (us)
  ExpectedTags expected;

  const CornerTrack* corner_track() const { return corners ? &*corners : nullptr; }
  bool has_tracks() const { return truth.camera && !camera_poses.empty() && !target_poses.empty(); }
};

/// Reads the truth and its files. Throws a usage Error for a truth that can't be, and for ids that the
/// family doesn't have; a family in the truth that isn't the detector's is an error, too.
LoadedTruth load_truth(const std::filesystem::path& path, const EvalConfig& config);

}  // namespace esi
