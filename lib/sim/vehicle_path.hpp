#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

namespace esi {

/// The vehicle's drive: straight on, a phase of bends left and right, straight on.
class VehiclePath {
 public:
  struct Plan {
    double speed_mps;
    double turn_rate_rad_s;  ///< largest, of a sine
    double turn_begin_s;
    double turn_end_s;
    double end_s;
  };
  explicit VehiclePath(const Plan& plan);

  double heading_rad(double t_s) const;
  cv::Vec2d velocity_mps(double t_s) const;
  cv::Vec2d position_m(double t_s) const;

 private:
  /// Way from one time to another not long after it (Simpson's rule).
  cv::Vec2d way(double from_s, double to_s) const;

  Plan plan_;
  double bend_rad_s_;                ///< angular frequency of the bends
  std::vector<cv::Vec2d> position_;  ///< at multiples of kKnot_s
};

}  // namespace esi
