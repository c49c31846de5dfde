#include "esi/sim/trajectory.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "esi/core/error.hpp"
#include "esi/sim/flight.hpp"

namespace esi {
namespace {

/// Times are kept in 31 bits of microseconds while events are made.
constexpr double kLongest_s = 1800.0;
constexpr std::int64_t kShortest_us = 1000;

/// The board stays; the camera moves by a formula.
class OverStandingBoard final : public Trajectory {
 public:
  using Motion = std::function<Pose(std::int64_t t_us)>;
  OverStandingBoard(std::string name, std::int64_t duration_us, Motion camera)
      : name_(std::move(name)), duration_us_(duration_us), camera_(std::move(camera)) {}

  std::int64_t duration_us() const override { return duration_us_; }
  Pose camera(std::int64_t t_us) const override { return camera_(t_us); }
  Pose board(std::int64_t /*t_us*/) const override { return {facing_down(0.0), {0, 0, kDeckHeight_m}}; }
  std::vector<Phase> phases() const override { return {{name_, {0, duration_us_}}}; }

 private:
  std::string name_;
  std::int64_t duration_us_;
  Motion camera_;
};

OverStandingBoard::Motion slide(const TrajectoryOptions& options, const Pose& above) {
  const double amplitude_m = options.slide_m;
  const double omega_rad_s = options.slide_mps / amplitude_m;
  return [=](std::int64_t t_us) {
    const double right_m = amplitude_m * std::sin(omega_rad_s * 1e-6 * static_cast<double>(t_us));
    return above * Pose{cv::Matx33d::eye(), {right_m, 0, 0}};
  };
}

OverStandingBoard::Motion rotation(const TrajectoryOptions& options, const Pose& above) {
  const double rate_rad_s = options.rotation_deg_s * std::numbers::pi / 180.0;
  return [=](std::int64_t t_us) {
    const double angle = rate_rad_s * 1e-6 * static_cast<double>(t_us);
    return above * Pose{rotation_about({0, 0, angle}), {}};
  };
}

std::unique_ptr<Trajectory> along(std::vector<TimedPose> poses) {
  const std::int64_t duration_us = poses.empty() ? 0 : poses.back().t_us - poses.front().t_us;
  if (duration_us < kShortest_us || static_cast<double>(duration_us) > kLongest_s * 1e6) {
    throw usage_error("option poses: give a file of poses that lasts 0.001 to 1800 s");
  }
  const std::int64_t first_us = poses.front().t_us;
  for (TimedPose& pose : poses) pose.t_us -= first_us;
  return std::make_unique<OverStandingBoard>(
      "poses", duration_us, [list = std::move(poses)](std::int64_t t_us) { return interpolate(list, t_us); });
}

}  // namespace

void TrajectoryOptions::declare(OptionTable& table) {
  table.choice("trajectory", kind, {"flight", "still", "slide", "rotation", "poses"},
               "how the camera moves: a flight with landing, or a simple motion over the standing board");
  table.real("duration_s", duration_s, {0.001, kLongest_s}, "s",
             "length; a flight's phases keep their shares (30 : 22 : 10 of 62 s) and its speeds");
  table.real("height_m", height_m, {0.2, 20.0}, "m",
             "camera above the board; a flight too short to come down from there begins lower");
  flight.declare(table);
  table.real("slide_m", slide_m, {0.001, 10.0}, "m", "how far a slide goes to either side");
  table.real("slide_mps", slide_mps, {0.0, 10.0}, "m/s",
             "fastest speed of a slide, above the board's middle");
  table.real("rotation_deg_s", rotation_deg_s, {-720.0, 720.0}, "deg/s", "rotation about the optical axis");
  table.text("poses", poses, "file of TUM lines 't tx ty tz qx qy qz qw': the camera in the world, z up");
}

cv::Matx33d facing_down(double heading_rad) {
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  return {s, -c, 0.0, -c, -s, 0.0, 0.0, 0.0, -1.0};
}

std::unique_ptr<Trajectory> make_trajectory(const TrajectoryOptions& options, std::int64_t seed) {
  using Kind = TrajectoryOptions::Kind;
  if (options.kind == Kind::flight) return std::make_unique<Flight>(options, seed);
  if (options.kind == Kind::poses) return along(options.pose_list);
  const std::int64_t duration_us = us_from_seconds(options.duration_s);
  const Pose above{facing_down(0.0), {0, 0, kDeckHeight_m + options.height_m}};
  if (options.kind == Kind::slide) {
    return std::make_unique<OverStandingBoard>("slide", duration_us, slide(options, above));
  }
  if (options.kind == Kind::rotation) {
    return std::make_unique<OverStandingBoard>("rotation", duration_us, rotation(options, above));
  }
  return std::make_unique<OverStandingBoard>("still", duration_us, [above](std::int64_t) { return above; });
}

}  // namespace esi
