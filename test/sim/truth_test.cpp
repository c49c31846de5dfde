#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "esi/sim/board.hpp"
#include "esi/sim/scenario.hpp"
#include "sim/tag_detections.hpp"

using namespace esi;

namespace {

double side_of(const SeenTag& tag) {
  return std::min(cv::norm(tag.corners[0] - tag.corners[1]), cv::norm(tag.corners[1] - tag.corners[2]));
}

double share_below(const std::vector<double>& sorted, double limit) {
  return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), limit) - sorted.begin()) /
         static_cast<double>(sorted.size());
}

}  // namespace

TEST_CASE("AprilTag finds the tags of clean frames where the truth says, throughout the flight") {
  const Scenario flight({}, {}, {}, 1);
  std::vector<double> errors;
  cv::Vec2d sum;
  int expected = 0, found = 0;
  for (std::int64_t t_us = 250'000; t_us <= flight.duration_us(); t_us += 500'000) {
    const auto seen = test::detect_tags(flight.clean_frame(t_us));
    for (const SeenTag& tag : flight.tags(t_us)) {
      if (!tag.visible || side_of(tag) < 24.0) continue;
      ++expected;
      const auto place = seen.find(static_cast<int>(tag.id));
      if (place == seen.end()) continue;
      ++found;
      for (std::size_t k = 0; k < 4; ++k) {
        const cv::Vec2d error = place->second[k] - tag.corners[k];
        errors.push_back(cv::norm(error));
        sum += error;
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  CAPTURE(expected, found, errors.size(), errors[errors.size() / 2], errors.back());
  CHECK(expected >= 124);
  CHECK(found >= expected * 0.98);
  CHECK(errors[errors.size() / 2] <= 0.2);
  CHECK(share_below(errors, 0.35) >= 0.95);
  const cv::Vec2d bias = sum / static_cast<double>(errors.size());
  CHECK(std::abs(bias[0]) <= 0.05);
  CHECK(std::abs(bias[1]) <= 0.05);
}

TEST_CASE("The board is in view as the phases say, to the touchdown") {
  const std::int64_t seed = GENERATE(1, 2, 3, 4);
  const Scenario flight({}, {}, {}, seed);
  const auto phases = flight.phases();
  REQUIRE(phases.size() == 3);
  CHECK(phases[0].interval == Interval{0, 30'000'000});
  CHECK(phases[1].interval == Interval{30'000'000, 52'000'000});
  CHECK(phases[2].interval == Interval{52'000'000, 62'000'000});
  for (const Phase& phase : phases) {
    INFO(phase.name << ", seed " << seed);
    double smallest_px = 1e9;
    for (std::int64_t t_us = phase.interval.begin_us; t_us <= phase.interval.end_us; t_us += 10'000) {
      double largest_px = 0.0;
      for (const SeenTag& tag : flight.tags(t_us)) {
        if (tag.visible) largest_px = std::max(largest_px, side_of(tag));
      }
      smallest_px = std::min(smallest_px, largest_px);
    }
    CHECK(smallest_px > 25.0);
  }
  const auto last = flight.tags(flight.duration_us());
  CHECK(last[1].visible);
  CHECK(side_of(last[1]) > 60.0);
}

TEST_CASE("A tag is not visible from behind, off the sensor, or behind an obstacle") {
  TrajectoryOptions still;
  still.kind = TrajectoryOptions::Kind::poses;
  const auto tags_from = [&still](const Pose& camera) {
    still.pose_list = {{0, camera}, {1'000'000, camera}};
    return Scenario({.obstacles = 0}, still, {}, 1).tags(0);
  };
  const cv::Matx33d down = facing_down(0.0);
  const auto above = tags_from({down, {0, 0, 2.3}});
  REQUIRE(above.size() == 2);
  CHECK(above[0].id == 0);
  CHECK(above[1].id == 1);
  CHECK(above[0].visible);
  CHECK(above[1].visible);
  // Large tag: 0.36 m at 2 m. The image's x is the world's -y here, so the tags lie to the left and right.
  const double focal_px = Camera(CameraOptions{}).focal_px;
  CHECK(side_of(above[0]) == Approx(0.18 * focal_px));
  CHECK(above[0].corners[0][0] == Approx(172.5 + focal_px * (-0.0675 - 0.18) / 2.0));
  CHECK(above[0].corners[0][1] == Approx(129.5 + focal_px * 0.09));
  CHECK(above[1].corners[2][0] == Approx(172.5 + focal_px * (0.23 + 0.05) / 2.0));
  CHECK(above[1].corners[2][1] == Approx(129.5 - focal_px * 0.025));

  const cv::Matx33d up = down * rotation_about({3.14159265358979, 0, 0});
  CHECK_FALSE(tags_from({up, {0, 0, 0.1}})[0].visible);  // from below, through the board
  CHECK_FALSE(tags_from({up, {0, 0, 2.3}})[0].visible);  // looking away
  CHECK_FALSE(tags_from({down, {0, 3.0, 2.3}})[0].visible);
}

TEST_CASE("A tag behind an obstacle is not visible") {
  TrajectoryOptions still;
  still.kind = TrajectoryOptions::Kind::still;
  const auto obstacles = Scenario({}, still, {}, 1).scene().obstacles();
  const auto tallest = std::max_element(obstacles.begin(), obstacles.end(),
                                        [](const Box& a, const Box& b) { return a.height_m < b.height_m; });
  REQUIRE(tallest->height_m > 0.6);
  // Beyond the obstacle, a little above the board, and looking at it.
  const cv::Vec2d place = tallest->centre_m * (1.0 + 0.6 / cv::norm(tallest->centre_m));
  const cv::Vec3d eye(place[0], place[1], 0.5);
  const cv::Vec3d forward = cv::normalize(cv::Vec3d(0, 0, kDeckHeight_m) - eye);
  const cv::Vec3d right = cv::normalize(forward.cross(cv::Vec3d(0, 0, 1)));
  const cv::Vec3d down = forward.cross(right);
  const Pose camera{
      {right[0], down[0], forward[0], right[1], down[1], forward[1], right[2], down[2], forward[2]}, eye};
  TrajectoryOptions looking;
  looking.kind = TrajectoryOptions::Kind::poses;
  looking.pose_list = {{0, camera}, {1'000'000, camera}};
  CHECK(Scenario({.obstacles = 0}, looking, {}, 1).tags(0)[0].visible);
  CHECK_FALSE(Scenario({}, looking, {}, 1).tags(0)[0].visible);
}

TEST_CASE("A line is blocked by a box where it goes through it") {
  Box box;
  box.centre_m = {1.0, 0.5};
  box.half_m = {0.2, 0.1};
  box.height_m = 0.8;
  box.heading_rad = 0.3;
  CHECK(box.blocks({2.0, 0.6, 0.5}, {0.0, 0.4, 0.5}));
  CHECK(box.blocks({1.0, 0.5, 3.0}, {1.0, 0.5, 0.0}));
  CHECK_FALSE(box.blocks({2.0, 0.6, 0.9}, {0.0, 0.4, 0.9}));     // over it
  CHECK_FALSE(box.blocks({2.0, 1.5, 0.5}, {0.0, 1.5, 0.5}));     // beside it
  CHECK_FALSE(box.blocks({0.5, 0.5, 0.5}, {0.0, 0.4, 0.5}));     // behind both ends
  CHECK_FALSE(box.blocks({1.25, 0.5, 0.5}, {1.25, -1.0, 0.5}));  // parallel to an axis, outside
}
