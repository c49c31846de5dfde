#include "esi/sim/noise_source.hpp"

#include <algorithm>
#include <cmath>

namespace esi {

std::int32_t NoiseSource::next_us(std::int32_t t_us) const {
  if (rate_hz_ <= 0.0) return kNever_us;
  const double wait_us = -std::log(random_.uniform(number(t_us, 0))) / rate_hz_ * 1e6;
  const double next_us = std::floor(t_us + wait_us) + 1.0;
  return next_us < kNever_us ? static_cast<std::int32_t>(next_us) : kNever_us;
}

std::optional<NoiseSource::Event> NoiseSource::draw(std::int32_t t_us, double light) const {
  const double drawn_hz = random_.uniform(number(t_us, 1)) * rate_hz_;
  if (drawn_hz < hot_hz_) return Event{true, EventCause::hot};
  // v2e: the rate falls on a straight line, from black to white.
  const double factor = 1.0 - (1.0 - options_->shot_white_factor) * std::clamp(light, 0.0, 1.0);
  if (drawn_hz - hot_hz_ >= factor * options_->shot_hz) return std::nullopt;
  return Event{random_.uniform(number(t_us, 2)) < options_->shot_on_share, EventCause::shot};
}

}  // namespace esi
