#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "esi/recon/decay.hpp"

namespace esi::test {

/// Decays of all forms with parameters drawn over their whole ranges: tau, alpha evenly in their logarithms.
/// Every other one has alpha = 0, every other one a whole n.
inline std::vector<DecayOptions> random_decays(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<DecayOptions> decays;
  for (int i = 0; i < count; ++i) {
    DecayOptions decay;
    decay.decay = static_cast<Decay>(i % 4);
    decay.tau_s = std::pow(10.0, uniform(-3.0, 3.0));
    decay.alpha_hz = (i / 4) % 2 == 0 ? 0.0 : std::pow(10.0, uniform(-3.0, 3.0));
    decay.n = uniform(1.0, 8.0);
    if ((i / 8) % 2 == 0) decay.n = std::floor(uniform(1.0, 4.0));
    decays.push_back(decay);
  }
  return decays;
}

}  // namespace esi::test
