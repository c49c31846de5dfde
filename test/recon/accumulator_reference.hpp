#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "esi/recon/accumulator.hpp"

namespace esi::test {

/// The accumulator straight from its equations in docs/methods.md, with V itself and time in seconds.
class AccumulatorReference {
 public:
  AccumulatorReference(const AccumulatorOptions& options, SensorSize size)
      : o_(options), width_(static_cast<std::size_t>(size.width_px)) {
    pixels_.resize(width_ * static_cast<std::size_t>(size.height_px), {o_.v_neutral, std::nullopt});
  }

  void process(std::span<const Event> events, std::span<const float> weights = {}) {
    for (std::size_t i = 0; i < events.size(); ++i) {
      Pixel& pixel = pixels_[events[i].y * width_ + events[i].x];
      pixel.v = potential(pixel, events[i].t_us);
      const double k = o_.contribution * (weights.empty() ? 1.0 : static_cast<double>(weights[i]));
      pixel.v = std::min(std::max(pixel.v + (events[i].on ? k : -k), o_.v_min), o_.v_max);
      pixel.t_us = events[i].t_us;
    }
  }

  double level(int x, int y, std::int64_t t_us) const {
    const Pixel& pixel = pixels_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
    const double v = o_.readout_decay ? potential(pixel, t_us) : pixel.v;
    return 255.0 * (v - o_.v_min) / (o_.v_max - o_.v_min);
  }

 private:
  struct Pixel {
    double v;
    std::optional<std::int64_t> t_us;
  };

  double potential(const Pixel& pixel, std::int64_t t_us) const {
    if (!pixel.t_us) return o_.v_neutral;
    const double dt_s = static_cast<double>(t_us - *pixel.t_us) * 1e-6;
    switch (o_.decay) {
      case AccumulatorDecay::exponential:
        return o_.v_neutral + (pixel.v - o_.v_neutral) * std::exp(-dt_s / o_.tau_s);
      case AccumulatorDecay::linear:
        if (pixel.v > o_.v_neutral) return std::max(pixel.v - o_.slope_hz * dt_s, o_.v_neutral);
        return std::min(pixel.v + o_.slope_hz * dt_s, o_.v_neutral);
      case AccumulatorDecay::step:
        return dt_s > o_.step_s ? o_.v_neutral : pixel.v;
      case AccumulatorDecay::none:
        break;
    }
    return pixel.v;
  }

  AccumulatorOptions o_;
  std::size_t width_;
  std::vector<Pixel> pixels_;
};

}  // namespace esi::test
