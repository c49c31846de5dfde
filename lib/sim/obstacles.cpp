#include "esi/sim/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "esi/sim/board.hpp"
#include "esi/sim/random.hpp"

namespace esi {
namespace {

/// The vehicle's half diagonal and as much again.
constexpr double kClearance_m = 0.9;
constexpr double kFarthest_m = 1.9;
constexpr double kMinHeight_m = 0.3;
constexpr double kMaxHeight_m = 1.0;
constexpr std::int64_t kPathStep_us = 200'000;
constexpr std::uint64_t kTriesPerBox = 20;
constexpr std::uint64_t kNumbersPerTry = 16;

cv::Vec2d place_of(const Pose& pose) { return {pose.position_m[0], pose.position_m[1]}; }

double radius_of(const Box& box) { return std::hypot(box.half_m[0], box.half_m[1]); }

std::vector<cv::Vec2d> way_of(const Trajectory& trajectory) {
  std::vector<cv::Vec2d> way;
  for (std::int64_t t_us = 0; t_us < trajectory.duration_us(); t_us += kPathStep_us) {
    way.push_back(place_of(trajectory.board(t_us)));
  }
  return way;
}

bool is_clear(const Box& box, const std::vector<cv::Vec2d>& way, const std::vector<Box>& others) {
  const double radius_m = radius_of(box);
  return std::all_of(
             way.begin(), way.end(),
             [&](const cv::Vec2d& p) { return cv::norm(p - box.centre_m) > kClearance_m + radius_m; }) &&
         std::all_of(others.begin(), others.end(), [&](const Box& other) {
           return cv::norm(other.centre_m - box.centre_m) > radius_of(other) + radius_m;
         });
}

Box random_box(const Trajectory& trajectory, const RandomKey& random, std::uint64_t n) {
  const Interval interval = trajectory.among_obstacles();
  const auto t_us = interval.begin_us + static_cast<std::int64_t>(
                                            random.uniform(n) * static_cast<double>(interval.duration_us()));
  Box box;
  box.half_m = {random.uniform(n + 1, 0.15, 0.3), random.uniform(n + 2, 0.15, 0.3)};
  box.height_m = random.uniform(n + 3, kMinHeight_m, kMaxHeight_m);
  box.heading_rad = random.uniform(n + 4, 0.0, std::numbers::pi);
  const double away_m = random.uniform(n + 5, kClearance_m, kFarthest_m) + radius_of(box);
  const double angle = random.uniform(n + 6, 0.0, 2.0 * std::numbers::pi);
  box.centre_m = place_of(trajectory.board(t_us)) + away_m * cv::Vec2d(std::cos(angle), std::sin(angle));
  box.gain = static_cast<float>(std::exp(random.uniform(n + 7, std::log(0.4), std::log(2.5))));
  box.texture_offset = {random.uniform(n + 8, 0.0, 2048.0), random.uniform(n + 9, 0.0, 2048.0)};
  return box;
}

}  // namespace

std::vector<Box> place_obstacles(std::int64_t count, const Trajectory& trajectory, std::int64_t seed) {
  const RandomKey random(seed, RandomStream::obstacle);
  const std::vector<cv::Vec2d> way = way_of(trajectory);
  std::vector<Box> boxes;
  const std::uint64_t tries = kTriesPerBox * static_cast<std::uint64_t>(count);
  for (std::uint64_t i = 0; i < tries && static_cast<std::int64_t>(boxes.size()) < count; ++i) {
    const Box box = random_box(trajectory, random, i * kNumbersPerTry);
    if (is_clear(box, way, boxes)) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace esi
