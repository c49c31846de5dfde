#include "esi/eval/tracker.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "esi/core/error.hpp"
#include "eval/tag_scene.hpp"

using namespace esi;
using esi::test::kCamera;
using esi::test::rodrigues;
using Outcome = Tracker::Outcome;

namespace {

/// Looks down from 3 m.
Pose camera_at(double x) { return {rodrigues({3.0, 0.1, -0.2}), {x, 0.2, 3.0}}; }

TargetMeasurement measure(const cv::Vec3d& world_m, const Pose& camera, double depth_noise_m = 0.03) {
  const cv::Vec3d uvd = project(world_m, camera, kCamera)->uvd;
  return {uvd[0], uvd[1], uvd[2], depth_noise_m};
}

/// A tracker that has seen a target at 1 m/s along x for a second, every 10 ms; true noise is small.
struct Running {
  Tracker tracker{TrackerOptions{}, kCamera};
  static cv::Vec3d target(double t_s) { return {t_s, 0.1, 0.3}; }
  Running() {
    for (int k = 0; k <= 100; ++k) update(10'000 * k, {});
  }
  Outcome update(std::int64_t t_us, const cv::Vec3d& offset_m) {
    const double t_s = static_cast<double>(t_us) / 1e6;
    return tracker.update(t_us, measure(target(t_s) + offset_m, camera_at(t_s)), camera_at(t_s));
  }
};

}  // namespace

TEST_CASE("The projection's derivative is the numerical one") {
  const Pose camera = camera_at(0.3);
  for (const cv::Vec3d& point :
       {cv::Vec3d(0.1, 0.2, 0.3), cv::Vec3d(-0.8, 0.9, -0.2), cv::Vec3d(0.9, -0.3, 1.5)}) {
    const auto projection = project(point, camera, kCamera);
    REQUIRE(projection);
    for (int axis = 0; axis < 3; ++axis) {
      cv::Vec3d step;
      step[axis] = 1e-5;
      const cv::Vec3d difference =
          (project(point + step, camera, kCamera)->uvd - project(point - step, camera, kCamera)->uvd) / 2e-5;
      for (int row = 0; row < 3; ++row)
        CHECK(projection->jacobian(row, axis) == Approx(difference[row]).margin(1e-5));
    }
    CHECK(cv::norm(unproject(projection->uvd, camera, kCamera) - point) < 1e-12);
  }
  CHECK_FALSE(project({0, 0, 5}, camera, kCamera));
}

TEST_CASE("A projected point is where OpenCV puts it") {
  const Pose camera = camera_at(0.3);
  const Pose tag = camera.inverse() * Pose{rodrigues({3.1, 0, 0}), {0.4, -0.1, 0.2}};
  const auto corners = esi::test::tag_corners(tag, 1e-6);
  const cv::Vec3d uvd = project({0.4, -0.1, 0.2}, camera, kCamera)->uvd;
  CHECK(uvd[0] == Approx(corners[0]).margin(1e-3));
  CHECK(uvd[1] == Approx(corners[1]).margin(1e-3));
  CHECK(uvd[2] == Approx(tag.position_m[2]));
}

TEST_CASE("Two steps of prediction are one, and white acceleration spreads as it must") {
  TargetState state{0, {1, 2, 3}, {-1, 0, 2}, cv::Matx66d::eye()};
  state.covariance(0, 3) = state.covariance(3, 0) = 0.5;
  const TargetState once = predicted(state, 500'000, 2.0);
  const TargetState twice = predicted(predicted(state, 200'000, 2.0), 500'000, 2.0);
  CHECK(cv::norm(once.position_m - cv::Vec3d(0.5, 2, 4)) < 1e-12);
  CHECK(cv::norm(once.position_m - twice.position_m) < 1e-12);
  CHECK(cv::norm(once.covariance, twice.covariance) < 1e-12);
  // P_pp + 2 dt P_pv + dt^2 P_vv + q^2 dt^3 / 3, and so on.
  CHECK(once.covariance(0, 0) == Approx(1 + 0.5 + 0.25 + 4 * 0.125 / 3));
  CHECK(once.covariance(1, 1) == Approx(1 + 0.25 + 4 * 0.125 / 3));
  CHECK(once.covariance(1, 4) == Approx(0.5 + 4 * 0.25 / 2));
  CHECK(once.covariance(3, 3) == Approx(1 + 4 * 0.5));
  CHECK(once.t_us == 500'000);
}

TEST_CASE("The error is as large as the filter says, no larger, no smaller (NEES)") {
  TrackerOptions options;
  options.gate = 1e9;
  options.acceleration_noise = 0.3;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  int samples = 0;
  for (int run = 0; run < 60; ++run) {
    Tracker tracker(options, kCamera);
    cv::Vec3d position(0.0, 0.1, 0.3), velocity;
    for (int axis = 0; axis < 3; ++axis) velocity[axis] = 0.3 * normal(random);
    for (int k = 0; k <= 100; ++k) {
      const std::int64_t t_us = 20'000 * k;
      const Pose camera = camera_at(position[0]);
      Pose true_camera = camera;
      for (int axis = 0; axis < 3; ++axis) true_camera.position_m[axis] += 0.02 * normal(random);
      TargetMeasurement measurement = measure(position, true_camera, 0.05);
      measurement.u_px += 2.0 * normal(random);
      measurement.v_px += 2.0 * normal(random);
      measurement.depth_m += 0.05 * normal(random);
      tracker.update(t_us, measurement, camera);
      if (k >= 50 && k % 10 == 0) {
        const TargetState state = *tracker.at(t_us);
        const cv::Vec3d p = state.position_m - position, v = state.velocity_m_s - velocity;
        const cv::Vec6d error(p[0], p[1], p[2], v[0], v[1], v[2]);
        sum += error.dot(state.covariance.inv() * error);
        ++samples;
      }
      // White acceleration over a step of 20 ms, held constant in it: nearly the filter's.
      cv::Vec3d push;
      for (int axis = 0; axis < 3; ++axis) push[axis] = 0.3 * std::sqrt(0.02) * normal(random);
      position += 0.02 * velocity + 0.01 * push;
      velocity += push;
    }
  }
  // Six degrees of freedom; 360 samples that depend on each other: some 0.4 of deviation.
  CAPTURE(sum / samples, samples);
  CHECK(sum / samples == Approx(6.0).margin(1.0));
}

TEST_CASE("A target of constant velocity is found within three sigma") {
  const Running running;
  const TargetState state = *running.tracker.at(1'000'000);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(state.position_m[axis] - Running::target(1.0)[axis]) <
          3 * std::sqrt(state.covariance(axis, axis)));
    CHECK(std::sqrt(state.covariance(axis, axis)) < 0.05);
  }
  CHECK(state.velocity_m_s[0] == Approx(1.0).margin(0.1));
}

TEST_CASE("An outlier is gated and leaves no trace") {
  Running running;
  const TargetState before = *running.tracker.at(1'000'000);
  CHECK(running.update(1'010'000, {0.5, 0, 0}) == Outcome::gated);
  CHECK(running.update(1'010'000, {0, 0, 1.0}) == Outcome::gated);
  CHECK(running.tracker.at(1'010'000)->position_m == predicted(before, 1'010'000, 2.0).position_m);
  CHECK(running.update(1'020'000, {}) == Outcome::used);
}

TEST_CASE("The gate is the Mahalanobis distance's, with the options' limit") {
  const auto gates = [](double sigmas) {
    Tracker tracker({}, kCamera);
    const Pose camera = camera_at(0);
    const cv::Vec3d target(0, 0.1, 0.3);
    tracker.update(0, measure(target, camera), camera);
    const auto projection = project(target, camera, kCamera);
    // Of the first measurement and of the second: twice the same, as seen from one place at one time.
    const cv::Matx33d s = 2.0 * (cv::Matx33d::diag({4.0, 4.0, 0.0009}) +
                                 0.0004 * projection->jacobian * projection->jacobian.t());
    TargetMeasurement second = measure(target, camera);
    second.u_px += sigmas / std::sqrt(s.inv()(0, 0));
    return tracker.update(0, second, camera) == Outcome::gated;
  };
  CHECK_FALSE(gates(std::sqrt(11.34) - 0.01));
  CHECK(gates(std::sqrt(11.34) + 0.01));
}

TEST_CASE("A gap is bridged by prediction, and the target recognised after it") {
  Running running;
  const TargetState late = *running.tracker.at(1'800'000);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(late.position_m[axis] - Running::target(1.8)[axis]) <
          3 * std::sqrt(late.covariance(axis, axis)));
  }
  CHECK(late.covariance(0, 0) > 10 * running.tracker.at(1'000'000)->covariance(0, 0));
  CHECK(running.update(1'800'000, {}) == Outcome::used);
}

TEST_CASE("After the longest gap the track ends, and starts anew") {
  Running running;
  CHECK(running.tracker.at(3'000'000));
  CHECK_FALSE(running.tracker.at(3'000'001));
  CHECK(running.update(3'000'001, {0, 2, 0}) == Outcome::started);
  CHECK(running.tracker.at(3'000'001)->position_m[1] == Approx(2.1));
  CHECK(cv::norm(running.tracker.at(3'000'001)->velocity_m_s) == 0.0);
}

TEST_CASE("Measurements that are gated again and again start the track anew") {
  Running running;
  for (int k = 1; k < 10; ++k) CHECK(running.update(1'000'000 + 1'000 * k, {1, 0, 0}) == Outcome::gated);
  CHECK(running.update(1'010'000, {1, 0, 0}) == Outcome::started);
  CHECK(running.tracker.at(1'010'000)->position_m[0] == Approx(2.01));
  for (int k = 1; k < 10; ++k) running.update(1'010'000 + 1'000 * k, {0, 0, 0});
  CHECK(running.update(1'020'000, {1, 0, 0}) == Outcome::used);
  CHECK(running.update(1'021'000, {}) == Outcome::gated);  // counted from 1 again
}

TEST_CASE("Nothing is known before the first measurement, and none may come late") {
  Tracker tracker({}, kCamera);
  CHECK_FALSE(tracker.at(0));
  const Pose camera = camera_at(0);
  CHECK(tracker.update(10, measure({0, 0, 0}, camera), camera) == Outcome::started);
  CHECK_FALSE(tracker.at(9));
  CHECK_THROWS_AS(tracker.update(9, measure({0, 0, 0}, camera), camera), Error);
}
