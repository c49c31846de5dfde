#include "esi/io/writing/ground_truth_writer.hpp"
#include "esi/pipeline/simulation/regular_times.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"
#include "esi/sim/board.hpp"
#include "esi/sim/tag_image.hpp"

namespace esi {
namespace {

TrackPose track_pose(std::int64_t t_us, const Pose& pose) {
  const Quaternion q = quaternion_of(pose.rotation);
  const cv::Vec3d& p = pose.position_m;
  return {t_us, {p[0], p[1], p[2]}, {q.x, q.y, q.z, q.w}};
}

TrueCorners true_corners(std::int64_t t_us, const SeenTag& tag) {
  TrueCorners row{t_us, static_cast<int>(tag.id), tag.visible, {}};
  for (std::size_t i = 0; i < tag.corners.size(); ++i) {
    row.xy_px[2 * i] = tag.corners[i][0];
    row.xy_px[2 * i + 1] = tag.corners[i][1];
  }
  return row;
}

CameraModel camera_model(const Camera& camera) {
  return {camera.size.width_px,
          camera.size.height_px,
          camera.focal_px,
          camera.focal_px,
          camera.centre_px[0],
          camera.centre_px[1],
          {}};
}

TrueTags true_tags() {
  TrueTags tags{kTagFamily, {}, {}};
  for (const BoardTag& tag : board_tags()) {
    const int id = static_cast<int>(tag.id);
    tags.ids.push_back(id);
    tags.size_m[id] = tag.size_m;
  }
  return tags;
}

class TruthOutput final : public SimOutput {
 public:
  TruthOutput(const std::filesystem::path& folder, const Simulator& simulator,
              const SimOutputOptions& options)
      : path_(folder / "ground_truth.json"),
        corner_times_(options.corners_hz),
        pose_times_(options.poses_hz),
        corners_(folder / "corners.csv"),
        target_(folder / "target.tum"),
        camera_(folder / "camera.tum") {
    truth_.phases = simulator.phases();
    truth_.tags = true_tags();
    truth_.camera = camera_model(simulator.scenario().camera());
    truth_.corners = folder / "corners.csv";
    truth_.target_poses = folder / "target.tum";
    truth_.camera_poses = folder / "camera.tum";
    if (options.clean_frames) truth_.clean_frames = folder / "clean" / "images.txt";
  }

  void take(const Simulator& simulator, const Packet& /*packet*/) override {
    const Scenario& scenario = simulator.scenario();
    while (const auto t_us = corner_times_.next(simulator.t_us())) {
      for (const SeenTag& tag : scenario.tags(*t_us)) corners_.write(true_corners(*t_us, tag));
    }
    while (const auto t_us = pose_times_.next(simulator.t_us())) {
      target_.write(track_pose(*t_us, scenario.board_pose(*t_us)));
      camera_.write(track_pose(*t_us, scenario.camera_pose(*t_us)));
    }
  }

  void finish() override {
    corners_.finish();
    target_.finish();
    camera_.finish();
    write_ground_truth(path_, truth_);
  }

 private:
  std::filesystem::path path_;
  RegularTimes corner_times_, pose_times_;
  CornersWriter corners_;
  TrackWriter target_, camera_;
  GroundTruth truth_;
};

}  // namespace

std::unique_ptr<SimOutput> open_truth_output(const std::filesystem::path& folder, const Simulator& simulator,
                                             const SimOutputOptions& options) {
  return std::make_unique<TruthOutput>(folder, simulator, options);
}

}  // namespace esi
