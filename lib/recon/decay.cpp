#include "esi/recon/decay.hpp"

#include <cmath>
#include <limits>

namespace esi {

void DecayOptions::declare(OptionTable& table) {
  table.choice("decay", decay, {"polynomial", "power", "exponential", "none"},
               "gamma(dt), dt since a pixel's last event: exp(-alpha dt) times (1 - dt/tau)^n or "
               "1 - (dt/tau)^n; exp(-alpha dt); 1");
  table.real("tau_s", tau_s, {0.001, 1000.0}, "s", "support of the decay: an event is forgotten after it");
  table.real("n", n, {1.0, 8.0}, "", "degree of the decay");
  table.real("alpha_hz", alpha_hz, {0.0, 1000.0}, "1/s", "exponential rate of the decay");
}

double gamma(const DecayOptions& options, double dt_us) {
  if (dt_us >= support_us(options)) return 0.0;
  const double exponential = std::exp(-options.alpha_hz * dt_us * 1e-6);
  const double u = dt_us / support_us(options);
  switch (options.decay) {
    case Decay::polynomial:
      return exponential * std::pow(1.0 - u, options.n);
    case Decay::power:
      return exponential * (1.0 - std::pow(u, options.n));
    case Decay::exponential:
      return exponential;
    case Decay::none:
      break;
  }
  return 1.0;
}

double decay_loss(const DecayOptions& options, double dt_us) {
  if (dt_us >= support_us(options)) return 1.0;
  const double exponent = -options.alpha_hz * dt_us * 1e-6;
  const double u = dt_us / support_us(options);
  switch (options.decay) {
    case Decay::polynomial:
      return -std::expm1(exponent + options.n * std::log1p(-u));
    case Decay::power:
      return -std::expm1(exponent) + std::exp(exponent) * std::pow(u, options.n);
    case Decay::exponential:
      return -std::expm1(exponent);
    case Decay::none:
      break;
  }
  return 0.0;
}

double support_us(const DecayOptions& options) {
  const bool is_finite = options.decay == Decay::polynomial || options.decay == Decay::power;
  return is_finite ? std::round(options.tau_s * 1e6) : std::numeric_limits<double>::infinity();
}

}  // namespace esi
