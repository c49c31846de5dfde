#include "esi/sim/sway.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace esi {

Sway::Sway(double rms, double low_hz, double high_hz, const RandomKey& random) : waves_{} {
  const auto count = static_cast<double>(waves_.size());
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const double share = (static_cast<double>(i) + random.uniform(2 * i)) / count;
    const double frequency_hz = low_hz * std::pow(high_hz / low_hz, share);
    waves_[i] = {rms * std::sqrt(2.0 / count), 2.0 * std::numbers::pi * frequency_hz,
                 2.0 * std::numbers::pi * random.uniform(2 * i + 1)};
  }
}

double Sway::at(double t_s) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += wave.amplitude * std::sin(wave.omega_rad_s * t_s + wave.phase_rad);
  return sum;
}

}  // namespace esi
