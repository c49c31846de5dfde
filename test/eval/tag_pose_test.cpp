#include "esi/eval/tag_pose.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "esi/core/error.hpp"
#include "eval/tag_scene.hpp"

using namespace esi;
using esi::test::kCamera;
using esi::test::rodrigues;
using esi::test::tag_corners;
using esi::test::track_pose;

TEST_CASE("A tag is where its corners were projected from") {
  CameraModel bent = kCamera;
  bent.distortion = {-0.3, 0.1, 0.001, -0.002, 0.01};
  for (const CameraModel& camera : {kCamera, bent}) {
    for (const cv::Vec3d& turn :
         {cv::Vec3d(0.4, -0.3, 2.0), cv::Vec3d(-0.5, 0.1, -1.0), cv::Vec3d(0, 0.6, 0)}) {
      const Pose truth{rodrigues(turn), {0.3, -0.2, 1.5}};
      const auto found = estimate_tag_pose(tag_corners(truth, 0.36, camera), 0.36, camera);
      REQUIRE(found);
      CHECK(cv::norm(found->pose.position_m - truth.position_m) < 1e-4);
      CHECK(cv::norm(found->pose.rotation, truth.rotation) < 1e-3);
      CHECK(found->reprojection_error_px < 0.01);
      CHECK(found->other_error_px > found->reprojection_error_px);
    }
  }
}

TEST_CASE("A tag that is read upright by a frontal camera has the camera's axes") {
  const auto found = estimate_tag_pose({100, 150, 150, 150, 150, 100, 100, 100}, 0.5, kCamera);
  REQUIRE(found);
  CHECK(cv::norm(found->pose.rotation, cv::Matx33d::eye()) < 1e-3);
  CHECK(found->pose.position_m[0] == Approx((125 - kCamera.cx) * 0.01));
  CHECK(found->pose.position_m[1] == Approx((125 - kCamera.cy) * 0.01));
  CHECK(found->pose.position_m[2] == Approx(kCamera.fx * 0.01));
}

TEST_CASE("Corners that are no square's give nothing") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(estimate_tag_pose({kNan, 150, 150, 150, 150, 100, 100, 100}, 0.5, kCamera));
  CHECK_FALSE(estimate_tag_pose({10, 10, 10, 10, 10, 10, 10, 10}, 0.5, kCamera));
  CHECK_FALSE(estimate_tag_pose({10, 10, 20, 20, 30, 30, 40, 40}, 0.5, kCamera));
}

TEST_CASE("A number of distortion coefficients that nobody has is refused") {
  CameraModel camera = kCamera;
  camera.distortion = {0.1, 0.2, 0.3};
  CHECK_THROWS_WITH(estimate_tag_pose({}, 0.5, camera), Catch::Contains("has 3 distortion"));
  CHECK_THROWS_AS(require_usable(camera), Error);
}

TEST_CASE("Where the tags sit on the target is found from the truth") {
  const TrueTags tags{"tag36h11", {0, 1, 2}, {{0, 0.36}, {1, 0.1}}};
  const cv::Vec3d places[] = {{-0.1, 0.02, 0}, {0.2, -0.15, 0}, {0, 0, 0}};
  std::vector<TrackPose> camera_poses, target_poses;
  std::vector<TrueCorners> rows;
  for (int k = 0; k <= 20; ++k) {
    const std::int64_t t_us = 10'000 * k;
    const Pose camera{rodrigues({3.0 + 0.01 * k, 0.2, 0.1}), {0.02 * k, 0.1, 1.5}};
    const Pose target{rodrigues({3.1, 0.0, 0.02 * k}), {0.01 * k, 0.0, 0.3}};
    camera_poses.push_back(track_pose(t_us, camera));
    target_poses.push_back(track_pose(t_us, target));
    for (const int id : {0, 1, 2}) {
      const Pose tag = camera.inverse() * Pose{target.rotation, target * places[id]};
      rows.push_back({t_us, id, k < 8, tag_corners(tag, id == 1 ? 0.1 : 0.36)});
      if (k == 3) rows.back().xy_px = {};
      if (k >= 8) rows.back().xy_px[0] += 8.0;  // most rows, but not visible
    }
  }
  const auto found = locate_tags(tags, rows, kCamera, PoseTrack(camera_poses), PoseTrack(target_poses));
  REQUIRE(found.size() == 2);
  for (const int id : {0, 1}) {
    CHECK(cv::norm(found.at(id).centre_m - places[id]) < 1e-4);
    CHECK(found.at(id).size_m == tags.size_m.at(id));
  }
}
