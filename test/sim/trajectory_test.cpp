#include "esi/sim/trajectory.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "esi/core/error.hpp"
#include "esi/sim/scenario.hpp"
#include "esi/sim/step_plan.hpp"

using namespace esi;

namespace {

cv::Vec3d position_at(const Trajectory& trajectory, std::int64_t t_us) {
  return trajectory.camera(t_us).position_m;
}

double angle_of(const cv::Matx33d& r) {
  return std::acos(std::min(1.0, (r(0, 0) + r(1, 1) + r(2, 2) - 1.0) / 2.0));
}

}  // namespace

TEST_CASE("The airframe keeps its acceleration limit, and the camera's tilt comes from its acceleration") {
  TrajectoryOptions options;
  options.flight.attitude_jitter_deg = options.flight.vibration_deg = 0.0;
  options.flight.max_acceleration_mps2 = 0.4;  // low enough to be reached
  const auto flight = make_trajectory(options, 1);
  constexpr std::int64_t kStep_us = 10'000;
  double largest = 0.0, worst_tilt_error = 0.0;
  for (std::int64_t t_us = kStep_us; t_us < flight->duration_us(); t_us += kStep_us) {
    const cv::Vec3d acceleration = (position_at(*flight, t_us + kStep_us) - 2 * position_at(*flight, t_us) +
                                    position_at(*flight, t_us - kStep_us)) *
                                   1e4;
    largest = std::max(largest, cv::norm(acceleration));
    cv::Vec3d thrust = acceleration + cv::Vec3d(0, 0, 9.81);
    thrust /= cv::norm(thrust);
    const cv::Vec3d up = flight->camera(t_us).rotation * cv::Vec3d(0, 0, -1);
    worst_tilt_error = std::max(worst_tilt_error, cv::norm(up - thrust));
  }
  CHECK(largest <= 0.4 * 1.01);
  CHECK(largest > 0.3);
  CHECK(worst_tilt_error < 0.005);
}

TEST_CASE("A flight follows the vehicle, lands on its small tag, and keeps its speeds in a shorter time") {
  const double duration_s = GENERATE(62.0, 20.0, 3.0);
  TrajectoryOptions options;
  options.duration_s = duration_s;
  const auto flight = make_trajectory(options, 2);
  CHECK(flight->duration_us() == std::llround(duration_s * 1e6));
  CHECK(flight->phases()[1].interval.begin_us == std::llround(duration_s * 30e6 / 62.0));
  double fastest_mps = 0.0;
  for (std::int64_t t_us = 0; t_us + 100'000 <= flight->duration_us(); t_us += 100'000) {
    const cv::Vec3d away = flight->camera(t_us).position_m - flight->board(t_us).position_m;
    CHECK(std::hypot(away[0], away[1]) < 0.8);
    CHECK(away[2] > 0.15);
    CHECK(away[2] < 2.4);
    fastest_mps = std::max(fastest_mps,
                           cv::norm(position_at(*flight, t_us + 100'000) - position_at(*flight, t_us)) / 0.1);
  }
  CHECK(fastest_mps < 2.0);
  CHECK(flight->board(flight->duration_us()).position_m[0] > 0.3 * duration_s);  // the vehicle drives on
  const cv::Vec3d touchdown =
      flight->board(flight->duration_us()).inverse() * position_at(*flight, flight->duration_us());
  CHECK(touchdown[2] == Approx(-options.flight.touchdown_height_m).margin(0.06));
  CHECK(touchdown[0] == Approx(0.23).margin(0.08));
  CHECK(touchdown[1] == Approx(0.0).margin(0.08));
}

TEST_CASE("Vehicle and airframe turn in the turning phase, and only there") {
  const auto flight = make_trajectory({}, 1);
  const auto turned_deg = [&](double from_s, double to_s) {
    const auto from = flight->board(std::llround(from_s * 1e6)).rotation,
               to = flight->board(std::llround(to_s * 1e6)).rotation;
    return angle_of(from.t() * to) * 180.0 / CV_PI;
  };
  CHECK(turned_deg(0.0, 30.0) == Approx(0.0).margin(1e-6));
  CHECK(turned_deg(30.0, 35.5) > 60.0);
  CHECK(turned_deg(35.5, 41.0) > 60.0);
  CHECK(turned_deg(52.0, 62.0) == Approx(0.0).margin(1e-6));
  const auto facing = [&](std::int64_t t_us) {
    return flight->camera(t_us).rotation.t() * flight->board(t_us).rotation;
  };
  for (std::int64_t t_us = 0; t_us < 62'000'000; t_us += 500'000) CHECK(angle_of(facing(t_us)) < 0.45);
}

TEST_CASE(
    "Between two steps nothing on the sensor moves by more than asked, and no step is longer than 1 ms") {
  TrajectoryOptions options;
  options.flight.vibration_deg = 0.15;  // strong: 0.4 px a ms
  const Scenario flight({}, options, {}, 1);
  TimeStepOptions step;
  step.max_motion_px = 0.3;
  StepPlanner planner(step, flight);
  View before = planner.view();
  std::int32_t last_us = 0;
  int short_steps = 0;
  for (const PlannedStep& planned : planner.plan(200'000)) {
    CHECK(planned.time.begin_us == last_us);
    CHECK(planned.time.duration_us() <= 1000);
    REQUIRE(largest_motion_px(before, planned.view, flight.camera().size) <= 0.3);
    short_steps += planned.time.duration_us() < 1000;
    last_us = planned.time.end_us;
    before = planned.view;
  }
  CHECK(last_us == 200'000);
  CHECK(short_steps > 50);
}

TEST_CASE("The simple trajectories move as they say") {
  TrajectoryOptions options;
  options.duration_s = 2.0;
  options.height_m = 1.5;
  options.kind = TrajectoryOptions::Kind::still;
  const auto still = make_trajectory(options, 1);
  CHECK(still->camera(0).position_m == cv::Vec3d(0, 0, 1.8));
  CHECK(still->camera(1'900'000).position_m == still->camera(0).position_m);

  options.kind = TrajectoryOptions::Kind::slide;
  options.slide_m = 0.2;
  options.slide_mps = 0.5;
  const auto slide = make_trajectory(options, 1);
  // Facing along the world's x axis, right is -y.
  CHECK((slide->camera(1000).position_m - slide->camera(0).position_m)[1] == Approx(-0.5e-3).epsilon(1e-4));
  CHECK(slide->camera(628'319).position_m[1] ==
        Approx(-0.2).epsilon(1e-6));  // a quarter of the period 2 pi 0.2 / 0.5

  options.kind = TrajectoryOptions::Kind::rotation;
  options.rotation_deg_s = 45.0;
  const auto rotation = make_trajectory(options, 1);
  CHECK(angle_of(rotation->camera(0).rotation.t() * rotation->camera(1'000'000).rotation) ==
        Approx(CV_PI / 4));
  CHECK((rotation->camera(1'000'000).rotation * cv::Vec3d(0, 0, 1))[2] == Approx(-1.0));
  CHECK(rotation->phases()[0].name == "rotation");
  CHECK(rotation->phases()[0].interval == Interval{0, 2'000'000});
}

TEST_CASE("A list of poses is followed from its first time on, on straight lines and even turns") {
  TrajectoryOptions options;
  options.kind = TrajectoryOptions::Kind::poses;
  const cv::Matx33d down = rotation_of({0, 1, 0, 0});
  const double half = std::sqrt(0.5);
  const cv::Matx33d turned_down = rotation_of({0, half, -half, 0}),
                    the_same = rotation_of({0, -half, half, 0});
  options.pose_list = {{100'500'000, {down, {0, 0, 2}}},
                       {101'500'000, {turned_down, {1, 2, 3}}},
                       {102'500'000, {the_same, {1, 2, 3}}}};
  const auto poses = make_trajectory(options, 1);
  CHECK(poses->duration_us() == 2'000'000);
  CHECK(cv::norm(poses->camera(250'000).position_m - cv::Vec3d(0.25, 0.5, 2.25)) < 1e-12);
  const auto turned = [&](std::int64_t a, std::int64_t b) {
    return angle_of(poses->camera(a).rotation.t() * poses->camera(b).rotation) * 180.0 / CV_PI;
  };
  CHECK(turned(0, 250'000) == Approx(22.5));
  CHECK(turned(0, 1'000'000) == Approx(90.0));
  CHECK(turned(1'000'000, 2'000'000) == Approx(0.0).margin(1e-4));  // q and -q
}

TEST_CASE("A list of poses that lasts no time is refused") {
  TrajectoryOptions options;
  options.kind = TrajectoryOptions::Kind::poses;
  CHECK_THROWS_WITH(make_trajectory(options, 1), Catch::Contains("poses"));
  options.pose_list = {{5, {}}};
  CHECK_THROWS_WITH(make_trajectory(options, 1), Catch::Contains("poses"));
}
