#pragma once

#include <array>

#include "esi/sim/random.hpp"

namespace esi {

/// A smooth random motion: sines of random phase, equally strong, with frequencies spread over a band.
class Sway {
 public:
  Sway(double rms, double low_hz, double high_hz, const RandomKey& random);

  double at(double t_s) const;

 private:
  struct Wave {
    double amplitude, omega_rad_s, phase_rad;
  };
  std::array<Wave, 4> waves_;
};

}  // namespace esi
