#pragma once

#include <cstdint>

#include "esi/core/options.hpp"

namespace esi {

/// Two readings of the paper's "exponentially weighted polynomial with finite support", and two ablations.
enum class Decay {
  polynomial,   ///< exp(-alpha dt) (1 - dt/tau)^n
  power,        ///< exp(-alpha dt) (1 - (dt/tau)^n)
  exponential,  ///< exp(-alpha dt)
  none,         ///< 1
};

/// How a pixel's memory fades with the time dt since its last event.
struct DecayOptions {
  Decay decay = Decay::polynomial;
  double tau_s = 6.0;     ///< support: an event is forgotten after this long
  double n = 2.0;         ///< degree, >= 1 so that gamma(a) gamma(b) >= gamma(a + b)
  double alpha_hz = 0.0;  ///< exponential rate

  void declare(OptionTable& table);
};

/// The exact formula, for dt_us >= 0: falls from 1 at 0, and is 0 from the end of its support on.
double gamma(const DecayOptions& options, double dt_us);

/// 1 - gamma(dt_us), exact where that is tiny.
double decay_loss(const DecayOptions& options, double dt_us);

/// From here on gamma is 0: tau, to the microsecond as all times are. Infinite for `exponential` and `none`.
double support_us(const DecayOptions& options);

}  // namespace esi
