#pragma once

#include "esi/core/options.hpp"

namespace esi {

/// A small quadrotor follows a vehicle that carries the board, and lands on it.
struct FlightOptions {
  double speed_mps = 1.0;
  double turn_rate_deg_s = 20.0;
  double touchdown_height_m = 0.25;
  double max_acceleration_mps2 = 2.0;
  double wander_m = 0.12;
  double attitude_jitter_deg = 0.2;
  double vibration_deg = 0.03;
  double vibration_hz = 95.0;

  void declare(OptionTable& table);
};

}  // namespace esi
