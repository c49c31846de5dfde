#include "esi/eval/tracking.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "eval/tag_scene.hpp"

using namespace esi;
using esi::test::kCamera;
using esi::test::rodrigues;
using esi::test::tag_corners;
using esi::test::track_pose;

namespace {

/// A UAV above a target that drives at 1 m/s and turns; two tags on it, frames every 10 ms for 4 s.
struct Chase {
  std::map<int, TargetTag> tags{{0, {0.36, {-0.1, 0.02, 0}}}, {1, {0.1, {0.2, -0.15, 0}}}};
  std::vector<TrackPose> camera, target;
  std::vector<FrameDetections> frames;

  Chase() {
    for (int k = 0; k <= 400; ++k) {
      const std::int64_t t_us = 10'000 * k;
      const double t_s = 0.01 * k;
      const Pose eye{rodrigues({3.0, 0.15 * std::sin(t_s), 0.2}), {0.9 * t_s, 0.1, 2.0}};
      const Pose board{rodrigues({3.1, 0.3 * t_s, 0}), {t_s, 0.2 * std::sin(t_s), 0.3}};
      camera.push_back(track_pose(t_us, eye));
      target.push_back(track_pose(t_us, board));
      FrameDetections frame{k, t_us, {}};
      for (const auto& [id, tag] : tags) {
        const Pose seen = eye.inverse() * Pose{board.rotation, board * tag.centre_m};
        frame.detections.push_back({id, 0, 50, {}, tag_corners(seen, tag.size_m)});
      }
      frames.push_back(frame);
    }
  }
  TrackingRun run(const TrackingOptions& options = {}) const {
    return track_target(frames, tags, kCamera, PoseTrack(camera), options);
  }
  TrackingScore score(const TrackingRun& run, const TrackingOptions& options = {}) const {
    const std::vector<Phase> phases{
        {"one", {0, 2'000'000}}, {"two", {2'000'000, 4'000'000}}, {"late", {9'000'000, 9'500'000}}};
    return score_tracking(phases, run, PoseTrack(camera), PoseTrack(target), options);
  }
};

}  // namespace

TEST_CASE("A target is followed by its tags, each at its place on it") {
  const Chase chase;
  const TrackingRun run = chase.run();
  REQUIRE(run.frames.size() == 401);
  CHECK(run.used == 802);
  CHECK(run.starts == 1);
  CHECK(run.gated == 0);
  CHECK(run.unusable == 0);
  const TrackingScore score = chase.score(run);
  CHECK(score.phases[0].available.hits == 200);
  CHECK(score.phases[0].available.of == 200);
  CHECK(*score.phases[0].rmse_m < 0.02);
  CHECK(*score.phases[1].rmse_m < 0.02);
  CHECK(score.phases[1].longest_gap_us == 10'000);
  CHECK(score.phases[2].reason == "no frame lies in this phase");
  CHECK_FALSE(score.phases[2].available.value());
  CHECK_FALSE(score.phases[2].rmse_m);
  CHECK(score.phases[2].longest_gap_us == 500'000);
}

TEST_CASE("A tag measures the target's origin, its depth the less surely the further away") {
  const Pose target{rodrigues({0.3, -0.2, 0.4}), {0.2, 0.1, 2.0}};
  const TargetTag tag{0.36, {-0.1, 0.02, 0}};
  const Pose seen{target.rotation, target * tag.centre_m};
  Detection detection{0, 0, 50, {}, tag_corners(seen, tag.size_m)};
  TrackingOptions options;
  options.tracker.side_noise_px = 1.5;
  const auto found = measure_target(detection, tag, kCamera, options);
  REQUIRE(found);
  CHECK(found->u_px == Approx(172.5 + 206 * 0.1).margin(0.01));
  CHECK(found->v_px == Approx(129.5 + 206 * 0.05).margin(0.01));
  CHECK(found->depth_m == Approx(2.0).margin(1e-3));
  const double z = seen.position_m[2], side_px = 206 * 0.36 / z;
  CHECK(found->depth_noise_m == Approx(z * 1.5 / side_px).epsilon(1e-3));
  detection.xy_px[0] += 30;
  CHECK_FALSE(measure_target(detection, tag, kCamera, options));
}

TEST_CASE("A target that was lost is available for as long as allowed") {
  Chase chase;
  for (std::size_t k = 101; k < 180; ++k) chase.frames[k].detections.clear();
  const TrackingRun run = chase.run();
  CHECK(run.frames[150].age_us == 500'000);
  CHECK(run.frames[180].age_us == 0);
  CHECK(run.starts == 1);
  const TrackingScore score = chase.score(run);
  CHECK(score.phases[0].available.hits == 200 - 29);
  CHECK(score.phases[0].longest_gap_us == 300'000);
  CHECK(score.total.available.hits == 400 - 29);
  CHECK(score.total.available.of == 400);
}

TEST_CASE("Foreign tags, impossible corners and times without an own pose are not used") {
  Chase chase;
  chase.frames[10].detections[0].id = 99;
  chase.frames[20].detections[0].xy_px = {10, 10, 200, 200, 60, 30, 90, 250};
  chase.frames[30].detections[0].xy_px[3] = std::nan("");
  chase.camera.resize(399);
  const TrackingRun run = chase.run();
  CHECK(run.used == 802 - 3 - 4);
  CHECK(run.unusable == 2 + 4);
  CHECK_FALSE(run.frames[400].relative_m);
  CHECK(run.frames[398].relative_m);
}

TEST_CASE("A tag where none is doesn't move the track") {
  Chase chase;
  for (std::size_t k = 100; k < 400; k += 10) {
    for (double& value : chase.frames[k].detections[0].xy_px) value -= 80;
  }
  const TrackingRun run = chase.run();
  CHECK(run.gated == 30);
  CHECK(*chase.score(run).phases[1].rmse_m < 0.02);
}

TEST_CASE("What counts is the relative position: the UAV may be wrong about where it is") {
  Chase chase;
  const std::vector<TrackPose> truth = chase.camera;
  for (TrackPose& pose : chase.camera) pose.position_m[1] += 5.0;
  const TrackingRun run = chase.run();
  chase.camera = truth;
  CHECK(*chase.score(run).total.rmse_m < 0.02);
}

TEST_CASE("Errors are summed up over the frames that have a track") {
  Chase chase;
  TrackingRun run;
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const cv::Vec3d relative(chase.target[i].position_m[0] - chase.camera[i].position_m[0],
                             chase.target[i].position_m[1] - chase.camera[i].position_m[1],
                             chase.target[i].position_m[2] - chase.camera[i].position_m[2]);
    run.frames.push_back({10'000 * k, relative + cv::Vec3d(0, 0.3 * k, 0.4 * k), k == 3 ? 500'001 : 0});
  }
  run.frames.push_back({40'000, std::nullopt, 0});
  const PhaseTracking score = chase.score(run).phases[0];
  CHECK(score.available.hits == 3);
  CHECK(score.available.of == 5);
  CHECK(*score.rmse_m == Approx(std::sqrt((0.25 + 1.0) / 3)));
  CHECK(*score.error_median_m == Approx(0.5));
  CHECK(*score.error_max_m == Approx(1.0));
  CHECK(score.longest_gap_us == 1'980'000);
}
