#include "esi/eval/pose_track.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "esi/core/error.hpp"
#include "eval/tag_scene.hpp"

using namespace esi;
using esi::test::rodrigues;
using esi::test::track_pose;

namespace {

cv::Matx33d rotation_in(const TrackPose& pose) {
  const auto& q = pose.quaternion_xyzw;
  return rotation_of(Quaternion{q[0], q[1], q[2], q[3]});
}

TrackPose pose(std::int64_t t_us, double x, const cv::Vec3d& turn) {
  return track_pose(t_us, {rodrigues(turn), {x, 1, 2}});
}

double angle_between(const Pose& a, const cv::Matx33d& rotation) {
  cv::Vec3d turn;
  cv::Rodrigues(a.rotation.t() * rotation, turn);
  return cv::norm(turn);
}

}  // namespace

TEST_CASE("Between poses position goes straight and rotation about one axis") {
  const PoseTrack track(
      {pose(0, 0, {0, 0, 0}), pose(100'000, 4, {0, 0, 1.2}), pose(200'000, 0, {0, 0.001, 1.2})});
  CHECK(angle_between(*track.at(0), cv::Matx33d::eye()) < 1e-9);
  CHECK(track.at(25'000)->position_m == cv::Vec3d(1, 1, 2));
  CHECK(angle_between(*track.at(25'000), rodrigues({0, 0, 0.3})) < 1e-9);
  CHECK(track.at(100'000)->position_m[0] == 4.0);
  CHECK(track.at(150'000)->position_m[0] == Approx(2.0));
  CHECK(angle_between(*track.at(150'000), rodrigues({0, 0.0005, 1.2})) < 1e-6);
}

TEST_CASE("The shorter way is taken, whatever the quaternion's sign and length") {
  TrackPose end = pose(100'000, 4, {0, 0, 0.4});
  for (double& part : end.quaternion_xyzw) part *= -3.0;
  const PoseTrack track({pose(0, 0, {0, 0, -0.4}), end});
  CHECK(angle_between(*track.at(50'000), cv::Matx33d::eye()) < 1e-9);
  CHECK(angle_between(*track.at(100'000), rodrigues({0, 0, 0.4})) < 1e-9);
}

TEST_CASE("Poses outside a track, in its gaps, and in no order") {
  const PoseTrack track({pose(0, 0, {}), pose(100'000, 4, {}), pose(200'001, 0, {})});
  CHECK_FALSE(track.at(-1));
  CHECK_FALSE(track.at(200'002));
  CHECK(track.at(99'999));
  CHECK_FALSE(track.at(100'001));
  CHECK(track.at(200'001));
  CHECK_FALSE(PoseTrack({}).at(0));
  CHECK_THROWS_AS(PoseTrack({pose(10, 0, {}), pose(10, 0, {})}), Error);
}

TEST_CASE("A UAV's own poses are wrong by as much as was asked for, for as long") {
  std::vector<TrackPose> truth;
  for (int k = 0; k < 20000; ++k) truth.push_back(pose(10'000 * k, 0.001 * k, {0.3, 0.2, 0.0001 * k}));
  PoseNoise noise;
  noise.position_m = 0.05;
  noise.angle_deg = 2.0;
  noise.correlation_s = GENERATE(0.0, 0.1);
  const std::vector<TrackPose> noisy = with_noise(truth, noise);
  REQUIRE(noisy.size() == truth.size());
  cv::Vec3d squares, turns;
  double neighbours = 0.0, latest = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    CHECK(noisy[k].t_us == truth[k].t_us);
    cv::Vec3d turn;
    cv::Rodrigues(rotation_in(truth[k]).t() * rotation_in(noisy[k]), turn);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      squares[axis] += std::pow(noisy[k].position_m[i] - truth[k].position_m[i], 2) / 20000;
      turns[axis] += std::pow(turn[axis] * 180 / std::numbers::pi, 2) / 20000;
    }
    const double error = noisy[k].position_m[0] - truth[k].position_m[0];
    neighbours += error * latest / 20000;
    latest = error;
  }
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::sqrt(squares[axis]) == Approx(0.05).epsilon(0.06));
    CHECK(std::sqrt(turns[axis]) == Approx(2.0).epsilon(0.06));
  }
  const double expected = noise.correlation_s > 0.0 ? std::exp(-0.1) : 0.0;
  CHECK(neighbours / squares[0] == Approx(expected).margin(0.03));
}

TEST_CASE("Noise follows its seed") {
  const std::vector<TrackPose> truth{pose(0, 1, {0.1, 0, 0})};
  PoseNoise other;
  other.seed = 2;
  CHECK(with_noise(truth, {})[0].position_m == with_noise(truth, {})[0].position_m);
  CHECK(with_noise(truth, {})[0].quaternion_xyzw == with_noise(truth, {})[0].quaternion_xyzw);
  CHECK(with_noise(truth, {})[0].position_m != with_noise(truth, other)[0].position_m);
}
