#include "esi/eval/tracking.hpp"

#include <algorithm>

namespace esi {
namespace {

class TrackingLoop {
 public:
  TrackingLoop(const std::map<int, TargetTag>& tags, const CameraModel& camera, const PoseTrack& own_poses,
               const TrackingOptions& options)
      : tags_(tags),
        camera_(camera),
        own_poses_(own_poses),
        options_(options),
        tracker_(options.tracker, camera) {}

  void add(const FrameDetections& frame) {
    const auto own_pose = own_poses_.at(frame.t_us);
    for (const Detection& detection : frame.detections) {
      const auto tag = tags_.find(detection.id);
      if (tag == tags_.end()) continue;
      const auto measurement =
          own_pose ? measure_target(detection, tag->second, camera_, options_) : std::nullopt;
      if (!measurement) {
        ++run_.unusable;
        continue;
      }
      count(tracker_.update(frame.t_us, *measurement, *own_pose), frame.t_us);
    }
    TrackedFrame tracked{frame.t_us, std::nullopt, 0};
    const auto state = tracker_.at(frame.t_us);
    if (state && own_pose) {
      tracked.relative_m = state->position_m - own_pose->position_m;
      tracked.age_us = frame.t_us - latest_used_us_;
    }
    run_.frames.push_back(tracked);
  }

  TrackingRun take() { return std::move(run_); }

 private:
  void count(Tracker::Outcome outcome, std::int64_t t_us) {
    if (outcome == Tracker::Outcome::gated) {
      ++run_.gated;
      return;
    }
    ++run_.used;
    if (outcome == Tracker::Outcome::started) ++run_.starts;
    latest_used_us_ = t_us;
  }

  const std::map<int, TargetTag>& tags_;
  const CameraModel& camera_;
  const PoseTrack& own_poses_;
  const TrackingOptions& options_;
  Tracker tracker_;
  TrackingRun run_;
  std::int64_t latest_used_us_ = 0;
};

}  // namespace

void TrackingOptions::declare(OptionTable& table) {
  tracker.declare(table);
  table.real("max_reprojection", max_reprojection_px, {0.0, 1000.0}, "px",
             "largest reprojection error of a tag's pose that is used");
  table.real("max_age", max_age_s, {0.0, 3600.0}, "s",
             "a track counts as available for so long after its last measurement");
}

std::optional<TargetMeasurement> measure_target(const Detection& detection, const TargetTag& tag,
                                                const CameraModel& camera, const TrackingOptions& options) {
  const auto found = estimate_tag_pose(detection.xy_px, tag.size_m, camera);
  if (!found || !(found->reprojection_error_px <= options.max_reprojection_px)) return std::nullopt;
  const cv::Vec3d origin = found->pose * (-tag.centre_m);
  const auto seen = project(origin, {}, camera);
  if (!seen) return std::nullopt;
  // A side of s metres has f s / z pixels; hence the deviation of z = f s / side.
  const double depth_m = found->pose.position_m[2];
  const double depth_noise_m = depth_m * depth_m / (camera.fx * tag.size_m) * options.tracker.side_noise_px;
  return TargetMeasurement{seen->uvd[0], seen->uvd[1], seen->uvd[2], depth_noise_m};
}

TrackingRun track_target(std::span<const FrameDetections> frames, const std::map<int, TargetTag>& tags,
                         const CameraModel& camera, const PoseTrack& own_poses,
                         const TrackingOptions& options) {
  require_usable(camera);
  TrackingLoop loop(tags, camera, own_poses, options);
  for (const FrameDetections& frame : frames) loop.add(frame);
  return loop.take();
}

}  // namespace esi
