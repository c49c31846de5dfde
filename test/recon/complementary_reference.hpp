#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "esi/recon/complementary.hpp"

namespace esi::test {

/// The complementary filter straight from Scheerlinck et al.'s equations. Without frames it is the high-pass
/// filter.
class ComplementaryReference {
 public:
  ComplementaryReference(const ComplementaryOptions& options, SensorSize size)
      : o_(options),
        width_(static_cast<std::size_t>(size.width_px)),
        pixels_(width_ * static_cast<std::size_t>(size.height_px)) {}

  void process(std::span<const Event> events, std::span<const float> weights = {}) {
    for (std::size_t i = 0; i < events.size(); ++i) {
      Pixel& pixel = pixels_[events[i].y * width_ + events[i].x];
      pixel.l = log_intensity(pixel, events[i].t_us);
      const double weight = weights.empty() ? 1.0 : static_cast<double>(weights[i]);
      pixel.l += (events[i].on ? o_.c_on : -o_.c_off) * weight;
      pixel.t_us = events[i].t_us;
    }
  }

  /// share(x, y) is the frame's intensity, 0 to 1.
  template <class Share>
  void observe(std::int64_t t_us, Share share) {
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      pixels_[i].l = log_intensity(pixels_[i], t_us);
      pixels_[i].t_us = t_us;
      pixels_[i].frame = share(static_cast<int>(i % width_), static_cast<int>(i / width_));
    }
  }

  double level(int x, int y, std::int64_t t_us) const {
    const Pixel& pixel = pixels_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
    return 255.0 * (std::exp(log_intensity(pixel, t_us)) - 1.0 - o_.show_min) / (o_.show_max - o_.show_min);
  }

 private:
  struct Pixel {
    double l = std::log(1.5);
    double frame = 0.5;
    std::optional<std::int64_t> t_us;
  };

  // alpha falls linearly in L from log(1.05) to a tenth at log(1), and from log(1.95) to a tenth at log(2).
  double rate(double l_frame) const {
    const double rate = 2.0 * std::numbers::pi * o_.cutoff_hz;
    if (!o_.spare_saturated) return rate;
    double trusted = 1.0;
    if (l_frame < std::log(1.05)) trusted = l_frame / std::log(1.05);
    if (l_frame > std::log(1.95)) trusted = (std::log(2.0) - l_frame) / (std::log(2.0) - std::log(1.95));
    return rate * (0.1 + 0.9 * trusted);
  }

  double log_intensity(const Pixel& pixel, std::int64_t t_us) const {
    if (!pixel.t_us) return pixel.l;
    const double l_frame = std::log(1.0 + pixel.frame);
    const double beta = std::exp(-rate(l_frame) * static_cast<double>(t_us - *pixel.t_us) * 1e-6);
    return beta * pixel.l + (1.0 - beta) * l_frame;
  }

  ComplementaryOptions o_;
  std::size_t width_;
  std::vector<Pixel> pixels_;
};

}  // namespace esi::test
