#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/core/phase.hpp"
#include "esi/eval/detection.hpp"
#include "esi/eval/pose_track.hpp"
#include "esi/eval/statistics.hpp"
#include "esi/eval/tag_pose.hpp"
#include "esi/eval/tracker.hpp"

namespace esi {

struct TrackingOptions {
  TrackerOptions tracker;
  double max_reprojection_px = 5.0;
  double max_age_s = 0.5;

  void declare(OptionTable& table);
};

/// The target's origin as one of its tags shows it. Nothing where the tag's pose is not to be trusted.
std::optional<TargetMeasurement> measure_target(const Detection& detection, const TargetTag& tag,
                                                const CameraModel& camera,
                                                const TrackingOptions& options = {});

/// What the tracker believes at a frame's time, its detections included.
struct TrackedFrame {
  std::int64_t t_us = 0;
  std::optional<cv::Vec3d> relative_m;  ///< target less UAV along the world's axes; nothing without a track
  std::int64_t age_us = 0;              ///< since the last measurement used
};

struct TrackingRun {
  std::vector<TrackedFrame> frames;
  std::int64_t used = 0;      ///< measurements, those that started a track among them
  std::int64_t gated = 0;     ///< refused by the tracker
  std::int64_t unusable = 0;  ///< no pose, a reprojection error too large, or the UAV's own pose not known
  std::int64_t starts = 0;
};

/// Runs the tracker over frames that ascend in time. Of each frame the tags that are on the target are used
/// (which ones the truth confirms is not known here), as the target's origin: tag pose less the tag's place
/// on it. `own_poses` are the camera's as the UAV believes them.
TrackingRun track_target(std::span<const FrameDetections> frames, const std::map<int, TargetTag>& tags,
                         const CameraModel& camera, const PoseTrack& own_poses,
                         const TrackingOptions& options = {});

struct PhaseTracking {
  std::string name;
  Rate available;  ///< frames with a track that is not older than allowed
  std::optional<double> rmse_m, error_median_m, error_max_m;  ///< over those frames, of the relative position
  std::int64_t longest_gap_us = 0;  ///< without such a track; the phase's ends count
  std::string reason;               ///< why there is no rate, else empty
};

struct TrackingScore {
  std::vector<PhaseTracking> phases;
  PhaseTracking total;
};

/// Compares with the true poses. Frames for which these say nothing count for availability alone.
TrackingScore score_tracking(std::span<const Phase> phases, const TrackingRun& run,
                             const PoseTrack& true_camera, const PoseTrack& true_target,
                             const TrackingOptions& options = {});

}  // namespace esi
