#include "esi/sim/vehicle_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace esi {
namespace {

constexpr double kKnot_s = 0.05;
constexpr double kBend_s = 11.0;  ///< about this long is one bend to the left and back

}  // namespace

VehiclePath::VehiclePath(const Plan& plan) : plan_(plan), position_{cv::Vec2d(0, 0)} {
  const double turning_s = plan.turn_end_s - plan.turn_begin_s;
  const double bends = std::max(0.5, std::round(turning_s / kBend_s));
  bend_rad_s_ = 2.0 * std::numbers::pi * bends / turning_s;
  const auto knots = static_cast<std::size_t>(plan.end_s / kKnot_s) + 1;
  for (std::size_t k = 1; k < knots; ++k) {
    const double t_s = static_cast<double>(k) * kKnot_s;
    position_.push_back(position_.back() + way(t_s - kKnot_s, t_s));
  }
}

double VehiclePath::heading_rad(double t_s) const {
  // The integral of turn_rate * sin(bend_rad_s * t).
  const double turning_s = std::clamp(t_s, plan_.turn_begin_s, plan_.turn_end_s) - plan_.turn_begin_s;
  return plan_.turn_rate_rad_s / bend_rad_s_ * (1.0 - std::cos(bend_rad_s_ * turning_s));
}

cv::Vec2d VehiclePath::velocity_mps(double t_s) const {
  const double heading = heading_rad(t_s);
  return plan_.speed_mps * cv::Vec2d(std::cos(heading), std::sin(heading));
}

cv::Vec2d VehiclePath::way(double from_s, double to_s) const {
  const cv::Vec2d middle = velocity_mps(0.5 * (from_s + to_s));
  return (to_s - from_s) / 6.0 * (velocity_mps(from_s) + 4.0 * middle + velocity_mps(to_s));
}

cv::Vec2d VehiclePath::position_m(double t_s) const {
  const double knot = std::clamp(std::floor(t_s / kKnot_s), 0.0, static_cast<double>(position_.size() - 1));
  return position_[static_cast<std::size_t>(knot)] + way(knot * kKnot_s, t_s);
}

}  // namespace esi
