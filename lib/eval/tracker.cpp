#include "esi/eval/tracker.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {
namespace {

using Matx36d = cv::Matx<double, 3, 6>;
using Matx63d = cv::Matx<double, 6, 3>;

/// A 3x3 block of the 6x6 matrix.
void add_block(cv::Matx66d& matrix, int row, int column, const cv::Matx33d& block) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix(row + i, column + j) += block(i, j);
  }
}

cv::Matx33d scaled_identity(double factor) { return cv::Matx33d::eye() * factor; }

/// y = z - h(x), S = H P H' + R; only the position is seen, H = [J 0].
struct Innovation {
  cv::Vec3d y;
  Matx36d h;
  cv::Matx33d noise;        ///< R
  cv::Matx33d information;  ///< S^-1
  double squared_distance;  ///< Mahalanobis
};

Innovation innovate(const TargetState& state, const TargetMeasurement& measurement,
                    const Projection& expected, const cv::Matx33d& noise) {
  Innovation result{{}, Matx36d::zeros(), noise, {}, 0.0};
  result.y = cv::Vec3d(measurement.u_px, measurement.v_px, measurement.depth_m) - expected.uvd;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.h(i, j) = expected.jacobian(i, j);
  }
  result.information = (result.h * state.covariance * result.h.t() + noise).inv(cv::DECOMP_CHOLESKY);
  result.squared_distance = result.y.dot(result.information * result.y);
  return result;
}

// K = P H' S^-1, x <- x + K y, and Joseph's form of P, which keeps it symmetric and positive.
TargetState corrected(TargetState state, const Innovation& innovation) {
  const Matx63d gain = state.covariance * innovation.h.t() * innovation.information;
  const cv::Vec6d correction = gain * innovation.y;
  for (int i = 0; i < 3; ++i) {
    state.position_m[i] += correction[i];
    state.velocity_m_s[i] += correction[i + 3];
  }
  const cv::Matx66d rest = cv::Matx66d::eye() - gain * innovation.h;
  state.covariance = rest * state.covariance * rest.t() + gain * innovation.noise * gain.t();
  return state;
}

}  // namespace

void TrackerOptions::declare(OptionTable& table) {
  table.real("acceleration_noise", acceleration_noise, {0.0, 1000.0}, "m/s^1.5",
             "root of the spectral density of the target's white acceleration");
  table.real("pixel_noise", pixel_noise_px, {0.01, 100.0}, "px",
             "deviation of the tag's place in the image, the UAV's wrong angles included");
  table.real("side_noise", side_noise_px, {0.01, 100.0}, "px",
             "deviation of the tag's side in the image, from which that of its depth follows");
  table.real("own_position_noise", own_position_noise_m, {0.0, 100.0}, "m",
             "deviation of the UAV's own position");
  table.real("first_speed_noise", first_speed_noise_m_s, {0.0, 1000.0}, "m/s",
             "deviation of the target's speed from 0 when a track starts");
  table.real("gate", gate, {0.1, 1e9}, "",
             "largest squared Mahalanobis distance of a measurement (chi2 with 3 degrees, 99 %: 11.34)");
  table.integer("gated_in_a_row", gated_in_a_row, {1, 1000000}, "",
                "refused measurements in a row after which the track starts anew");
  table.real("longest_gap", longest_gap_s, {0.001, 3600.0}, "s",
             "time without a measurement after which the track ends");
}

std::optional<Projection> project(const cv::Vec3d& world_m, const Pose& camera_pose,
                                  const CameraModel& camera) {
  const Pose to_camera = camera_pose.inverse();
  const cv::Vec3d p = to_camera * world_m;
  const double z = p[2];
  if (!(z > 1e-6)) return std::nullopt;
  const cv::Matx33d by_point{camera.fx / z, 0.0,           -camera.fx * p[0] / (z * z),  //
                             0.0,           camera.fy / z, -camera.fy * p[1] / (z * z),  //
                             0.0,           0.0,           1.0};
  return Projection{{camera.cx + camera.fx * p[0] / z, camera.cy + camera.fy * p[1] / z, z},
                    by_point * to_camera.rotation};
}

cv::Vec3d unproject(const cv::Vec3d& uvd, const Pose& camera_pose, const CameraModel& camera) {
  return camera_pose *
         (uvd[2] * cv::Vec3d((uvd[0] - camera.cx) / camera.fx, (uvd[1] - camera.cy) / camera.fy, 1.0));
}

// x <- F x, P <- F P F' + Q with F = [I dt I; 0 I] and Q = q^2 [dt^3/3 I, dt^2/2 I; dt^2/2 I, dt I].
TargetState predicted(const TargetState& state, std::int64_t t_us, double acceleration_noise) {
  const double dt = static_cast<double>(t_us - state.t_us) / 1e6;
  cv::Matx66d transition = cv::Matx66d::eye();
  add_block(transition, 0, 3, scaled_identity(dt));
  TargetState next{t_us, state.position_m + dt * state.velocity_m_s, state.velocity_m_s,
                   transition * state.covariance * transition.t()};
  const double density = acceleration_noise * acceleration_noise;
  add_block(next.covariance, 0, 0, scaled_identity(density * dt * dt * dt / 3.0));
  add_block(next.covariance, 0, 3, scaled_identity(density * dt * dt / 2.0));
  add_block(next.covariance, 3, 0, scaled_identity(density * dt * dt / 2.0));
  add_block(next.covariance, 3, 3, scaled_identity(density * dt));
  return next;
}

Tracker::Tracker(const TrackerOptions& options, const CameraModel& camera)
    : options_(options), camera_(camera) {}

cv::Matx33d Tracker::noise_of(const TargetMeasurement& measurement, const cv::Matx33d& jacobian) const {
  const double pixel = options_.pixel_noise_px * options_.pixel_noise_px;
  const double own = options_.own_position_noise_m * options_.own_position_noise_m;
  const double depth = measurement.depth_noise_m * measurement.depth_noise_m;
  return cv::Matx33d::diag({pixel, pixel, depth}) + own * (jacobian * jacobian.t());
}

void Tracker::start(std::int64_t t_us, const TargetMeasurement& measurement, const Pose& camera_pose) {
  const cv::Vec3d uvd(measurement.u_px, measurement.v_px, measurement.depth_m);
  TargetState state{t_us, unproject(uvd, camera_pose, camera_), {}, {}};
  const auto projection = project(state.position_m, camera_pose, camera_);
  if (!projection) throw usage_error("the measured target lies behind the camera");
  const cv::Matx33d inverse = projection->jacobian.inv();
  add_block(state.covariance, 0, 0, inverse * noise_of(measurement, projection->jacobian) * inverse.t());
  const double speed = options_.first_speed_noise_m_s;
  add_block(state.covariance, 3, 3, scaled_identity(speed * speed));
  state_ = state;
  gated_in_a_row_ = 0;
}

std::optional<TargetState> Tracker::at(std::int64_t t_us) const {
  if (!state_ || t_us < state_->t_us) return std::nullopt;
  if (static_cast<double>(t_us - state_->t_us) > options_.longest_gap_s * 1e6) return std::nullopt;
  return predicted(*state_, t_us, options_.acceleration_noise);
}

Tracker::Outcome Tracker::update(std::int64_t t_us, const TargetMeasurement& measurement,
                                 const Pose& camera_pose) {
  if (state_ && t_us < latest_us_) {
    throw usage_error(fmt::format("a measurement at {} s comes after one at {} s", seconds_text(t_us),
                                  seconds_text(latest_us_)));
  }
  latest_us_ = t_us;
  std::optional<TargetState> state = at(t_us);
  const auto expected = state ? project(state->position_m, camera_pose, camera_) : std::nullopt;
  if (!expected) {
    start(t_us, measurement, camera_pose);
    return Outcome::started;
  }
  const Innovation innovation =
      innovate(*state, measurement, *expected, noise_of(measurement, expected->jacobian));
  if (!(innovation.squared_distance <= options_.gate)) {
    if (++gated_in_a_row_ < options_.gated_in_a_row) return Outcome::gated;
    start(t_us, measurement, camera_pose);
    return Outcome::started;
  }
  gated_in_a_row_ = 0;
  state_ = corrected(*state, innovation);
  return Outcome::used;
}

}  // namespace esi
