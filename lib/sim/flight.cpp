#include "esi/sim/flight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "esi/sim/board.hpp"

namespace esi {
namespace {

constexpr double kKnot_s = 0.01;
constexpr double kGravity_mps2 = 9.81;
constexpr double kDegree = std::numbers::pi / 180.0;

/// Paper, section on experiments: of 62 s, 30 s straight and 22 s turning.
constexpr double kTurnBegins = 30.0 / 62.0;
constexpr double kLandingBegins = 52.0 / 62.0;
constexpr double kMaxDescent_mps = 1.0;
/// So much of the acceleration limit a descent may take.
constexpr double kVerticalShare = 0.8;

/// Here the airframe strays as far as asked; in proportion to its height elsewhere.
constexpr double kWanderHeight_m = 2.0;

/// The autopilot's position loop, nearly critically damped: it lags by half a second.
constexpr double kStiffness_hz2 = 4.0;
constexpr double kDamping_hz = 3.6;
constexpr double kYawLag_s = 0.4;

/// Below the first height the airframe moves from above the board's middle to above the small tag, until the
/// second: between them both tags are in view.
constexpr double kLeaveLargeTag_m = 1.0;
constexpr double kReachSmallTag_m = 0.5;

/// 0 to 1 with no jerk at the ends (Perlin 2002).
double smooth(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (s * (s * 6.0 - 15.0) + 10.0);
}
constexpr double kSteepest = 1.875;  ///< largest slope of smooth()
constexpr double kSharpest = 5.774;  ///< largest second derivative, 10 / sqrt(3)

std::int64_t share_of(double duration_s, double share) { return us_from_seconds(duration_s * share); }

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

/// The height to follow at: the asked one, or where the landing is short, one from which it can come down.
double height_within_reach(const TrajectoryOptions& options, double landing_s) {
  const double touchdown_m = options.flight.touchdown_height_m;
  const double by_speed_m = kMaxDescent_mps * landing_s / kSteepest;
  const double by_acceleration_m =
      kVerticalShare * options.flight.max_acceleration_mps2 * landing_s * landing_s / kSharpest;
  return std::max(touchdown_m,
                  std::min(options.height_m, touchdown_m + std::min(by_speed_m, by_acceleration_m)));
}

std::array<Sway, 3> sways(double rms, double low_hz, double high_hz, std::int64_t seed, std::uint64_t first) {
  const auto axis = [&](std::uint64_t i) {
    return Sway(rms, low_hz, high_hz, RandomKey(seed, RandomStream::wander, first + i));
  };
  return {axis(0), axis(1), axis(2)};
}

cv::Vec3d at(const std::array<Sway, 3>& sways, double t_s) {
  return {sways[0].at(t_s), sways[1].at(t_s), sways[2].at(t_s)};
}

/// The shortest turn from straight up to the direction of the thrust that accelerates the airframe.
cv::Matx33d tilt_of(const cv::Vec3d& acceleration) {
  const cv::Vec3d thrust = acceleration + cv::Vec3d(0, 0, kGravity_mps2);
  const cv::Vec3d axis(-thrust[1], thrust[0], 0.0);  // up x thrust
  const double length = std::hypot(axis[0], axis[1]);
  if (length < 1e-12) return cv::Matx33d::eye();
  return rotation_about(std::atan2(length, thrust[2]) / length * axis);
}

cv::Vec3d limited(const cv::Vec3d& vector, double longest) {
  const double length = std::sqrt(vector.dot(vector));
  return length > longest ? longest / length * vector : vector;
}

}  // namespace

void FlightOptions::declare(OptionTable& table) {
  table.real("speed_mps", speed_mps, {0.0, 5.0}, "m/s", "speed of the vehicle that carries the board");
  table.real("turn_rate_deg_s", turn_rate_deg_s, {0.0, 60.0}, "deg/s", "fastest turn of the vehicle");
  table.real("touchdown_height_m", touchdown_height_m, {0.2, 1.0}, "m",
             "camera above the board when the landing gear touches it");
  table.real("max_acceleration_mps2", max_acceleration_mps2, {0.1, 10.0}, "m/s^2",
             "acceleration limit of the airframe; tilts it by up to atan(limit / 9.81)");
  table.real(
      "wander_m", wander_m, {0.0, 1.0}, "m",
      "deviation by which the airframe strays while following, at 2 m above the board; less when lower");
  table.real("attitude_jitter_deg", attitude_jitter_deg, {0.0, 5.0}, "deg",
             "deviation of the attitude at 2 to 9 Hz, from control");
  table.real("vibration_deg", vibration_deg, {0.0, 1.0}, "deg", "deviation of the attitude from the rotors");
  table.real("vibration_hz", vibration_hz, {20.0, 300.0}, "Hz", "frequency of the rotors");
}

Flight::Flight(const TrajectoryOptions& options, std::int64_t seed)
    : options_(options.flight),
      turn_us_(share_of(options.duration_s, kTurnBegins)),
      land_us_(share_of(options.duration_s, kLandingBegins)),
      end_us_(us_from_seconds(options.duration_s)),
      follow_height_m_(height_within_reach(options, seconds(end_us_ - land_us_))),
      vehicle_({options_.speed_mps, options_.turn_rate_deg_s * kDegree, seconds(turn_us_), seconds(land_us_),
                seconds(end_us_)}),
      wander_(sways(options_.wander_m, 0.08, 0.6, seed, 0)),
      yaw_wander_(2.0 * kDegree, 0.1, 0.5, RandomKey(seed, RandomStream::wander, 3)),
      jitter_(sways(options_.attitude_jitter_deg * kDegree, 2.0, 9.0, seed, 4)),
      vibration_(sways(options_.vibration_deg * kDegree, 0.95 * options_.vibration_hz,
                       1.05 * options_.vibration_hz, seed, 7)) {
  fly();
}

double Flight::height_m(double t_s) const {
  const double landing = (t_s - seconds(land_us_)) / seconds(end_us_ - land_us_);
  return options_.touchdown_height_m +
         (follow_height_m_ - options_.touchdown_height_m) * (1.0 - smooth(landing));
}

cv::Vec3d Flight::wanted_position(double t_s) const {
  const double height = height_m(t_s);
  const double over_small = smooth((kLeaveLargeTag_m - height) / (kLeaveLargeTag_m - kReachSmallTag_m));
  const cv::Vec2d aim_m = over_small * board_tags().back().centre_m;
  const cv::Vec3d aim = board(us_from_seconds(t_s)) * cv::Vec3d(aim_m[0], aim_m[1], -height);
  return aim + height / kWanderHeight_m * at(wander_, t_s);
}

cv::Vec3d Flight::wanted_velocity(double t_s) const {
  const cv::Vec2d along = vehicle_.velocity_mps(t_s);
  const double climb = (height_m(t_s + 0.5 * kKnot_s) - height_m(t_s - 0.5 * kKnot_s)) / kKnot_s;
  return {along[0], along[1], climb};
}

/// Of the height alone: the vehicle's bends come as a surprise to the autopilot.
cv::Vec3d Flight::wanted_acceleration(double t_s) const {
  const double bend = height_m(t_s + kKnot_s) - 2.0 * height_m(t_s) + height_m(t_s - kKnot_s);
  return {0.0, 0.0, bend / (kKnot_s * kKnot_s)};
}

void Flight::fly() {
  Knot now{wanted_position(0.0), wanted_velocity(0.0), {}};
  const auto count = static_cast<std::size_t>(std::ceil(seconds(end_us_) / kKnot_s)) + 2;
  for (std::size_t k = 0; k < count; ++k) {
    const double t_s = static_cast<double>(k) * kKnot_s;
    const cv::Vec3d correction = kStiffness_hz2 * (wanted_position(t_s) - now.position) +
                                 kDamping_hz * (wanted_velocity(t_s) - now.velocity);
    now.acceleration = limited(wanted_acceleration(t_s) + correction, options_.max_acceleration_mps2);
    knots_.push_back(now);
    now.velocity += kKnot_s * now.acceleration;
    now.position += kKnot_s * now.velocity;
  }
}

Flight::Knot Flight::airframe(double t_s) const {
  const double last = static_cast<double>(knots_.size()) - 2.0;
  const double knot = std::clamp(std::floor(t_s / kKnot_s), 0.0, last);
  const Knot& a = knots_[static_cast<std::size_t>(knot)];
  const Knot& b = knots_[static_cast<std::size_t>(knot) + 1];
  const double s = t_s / kKnot_s - knot;
  // Hermite's cubic: position and velocity are continuous.
  const double to_b = s * s * (3.0 - 2.0 * s);
  const cv::Vec3d position =
      (1.0 - to_b) * a.position + to_b * b.position +
      kKnot_s * (s * (1.0 - s) * (1.0 - s) * a.velocity - s * s * (1.0 - s) * b.velocity);
  return {position, {}, (1.0 - s) * a.acceleration + s * b.acceleration};
}

Pose Flight::camera(std::int64_t t_us) const {
  const double t_s = seconds(t_us);
  const Knot frame = airframe(t_s);
  const double yaw = vehicle_.heading_rad(t_s - kYawLag_s) + yaw_wander_.at(t_s);
  const cv::Vec3d shake = at(jitter_, t_s) + at(vibration_, t_s);
  return {tilt_of(frame.acceleration) * facing_down(yaw) * rotation_about(shake), frame.position};
}

Pose Flight::board(std::int64_t t_us) const {
  const double t_s = seconds(t_us);
  const cv::Vec2d place = vehicle_.position_m(t_s);
  return {facing_down(vehicle_.heading_rad(t_s)), {place[0], place[1], kDeckHeight_m}};
}

std::vector<Phase> Flight::phases() const {
  return {{"straight", {0, turn_us_}}, {"turning", {turn_us_, land_us_}}, {"landing", {land_us_, end_us_}}};
}

}  // namespace esi
