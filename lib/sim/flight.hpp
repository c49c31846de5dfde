#pragma once

#include <array>
#include <vector>

#include "esi/sim/sway.hpp"
#include "esi/sim/trajectory.hpp"
#include "esi/sim/vehicle_path.hpp"

namespace esi {

/// The flight of docs/methods.md: straight, turning among obstacles, landing until touchdown. A camera that
/// is fixed to the airframe looks down, so whatever tilts the airframe moves the image.
class Flight final : public Trajectory {
 public:
  Flight(const TrajectoryOptions& options, std::int64_t seed);

  std::int64_t duration_us() const override { return end_us_; }
  Pose camera(std::int64_t t_us) const override;
  Pose board(std::int64_t t_us) const override;
  std::vector<Phase> phases() const override;
  Interval among_obstacles() const override { return {turn_us_, land_us_}; }

 private:
  /// The airframe at a multiple of kKnot_us.
  struct Knot {
    cv::Vec3d position, velocity, acceleration;
  };

  double height_m(double t_s) const;  ///< wanted, above the deck
  cv::Vec3d wanted_position(double t_s) const;
  cv::Vec3d wanted_velocity(double t_s) const;
  cv::Vec3d wanted_acceleration(double t_s) const;
  void fly();
  Knot airframe(double t_s) const;

  FlightOptions options_;
  std::int64_t turn_us_, land_us_, end_us_;  ///< where the phases begin, and the touchdown
  double follow_height_m_;
  VehiclePath vehicle_;
  std::array<Sway, 3> wander_;     ///< of the position, metres
  Sway yaw_wander_;                ///< radians
  std::array<Sway, 3> jitter_;     ///< of the attitude, radians
  std::array<Sway, 3> vibration_;  ///< of the attitude, radians
  std::vector<Knot> knots_;
};

}  // namespace esi
