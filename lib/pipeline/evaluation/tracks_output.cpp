#include "esi/pipeline/evaluation/tracks_output.hpp"

#include <fmt/format.h>

#include <set>

#include "esi/io/writing/ground_truth_writer.hpp"

namespace esi {
namespace {

TrackPose pose_at(std::int64_t t_us, const cv::Vec3d& position_m) {
  return {t_us, {position_m[0], position_m[1], position_m[2]}, {0, 0, 0, 1}};
}

void write_track(const std::filesystem::path& path, const TrackingRun& run) {
  TrackWriter writer(path);
  for (const TrackedFrame& frame : run.frames) {
    if (frame.relative_m) writer.write(pose_at(frame.t_us, *frame.relative_m));
  }
  writer.finish();
}

void write_truth(const std::filesystem::path& path, const InputRun& input) {
  const PoseTrack camera(input.truth.camera_poses), target(input.truth.target_poses);
  TrackWriter writer(path);
  for (const TrackPose& pose : input.truth.target_poses) {
    const auto from = camera.at(pose.t_us), to = target.at(pose.t_us);
    if (from && to) writer.write(pose_at(pose.t_us, to->position_m - from->position_m));
  }
  writer.finish();
}

}  // namespace

bool is_track_name(std::string_view name) {
  if (!name.ends_with(".tum")) return false;
  return name.starts_with("track_") || name.starts_with("truth_");
}

void write_tracks(const std::filesystem::path& folder, const Evaluation& evaluation,
                  const std::vector<InputResult>& results) {
  const std::size_t pooled = results.size() - evaluation.inputs.size();
  for (std::size_t i = 0; i < evaluation.inputs.size(); ++i) {
    const auto& methods = results[pooled + i].methods;
    bool any = false;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (!methods[m].tracking_run) continue;
      any = true;
      write_track(folder / fmt::format("track_{}_{}.tum", i, m), *methods[m].tracking_run);
    }
    if (any) write_truth(folder / fmt::format("truth_{}.tum", i), evaluation.inputs[i]);
  }
}

}  // namespace esi
