#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "esi/recon/esi.hpp"

namespace esi::test {

/// gamma(dt) in the words of docs/methods.md. tau counts to the microsecond.
inline double reference_gamma(const DecayOptions& o, double dt_s) {
  const double tau_s = std::round(o.tau_s * 1e6) * 1e-6;
  const bool is_finite = o.decay == Decay::polynomial || o.decay == Decay::power;
  if (is_finite && dt_s >= tau_s) return 0.0;
  if (o.decay == Decay::polynomial) return std::exp(-o.alpha_hz * dt_s) * std::pow(1.0 - dt_s / tau_s, o.n);
  if (o.decay == Decay::power) return std::exp(-o.alpha_hz * dt_s) * (1.0 - std::pow(dt_s / tau_s, o.n));
  return o.decay == Decay::exponential ? std::exp(-o.alpha_hz * dt_s) : 1.0;
}

/// ESI straight from its equations: slow, in double precision, with absolute times.
class EsiReference {
 public:
  EsiReference(const EsiOptions& options, SensorSize size)
      : o_(options),
        width_(static_cast<std::size_t>(size.width_px)),
        pixels_(width_ * static_cast<std::size_t>(size.height_px)) {}

  void process(std::span<const Event> events) {
    for (const Event& event : events) {
      Pixel& pixel = pixels_[event.y * width_ + event.x];
      if (pixel.t_us) pixel.e *= reference_gamma(o_.decay, seconds_between(*pixel.t_us, event.t_us));
      pixel.e += event.on ? o_.c_on : -o_.c_off;
      pixel.t_us = event.t_us;
      pixel.e = std::clamp(pixel.e, o_.e_min, o_.e_max);
    }
  }

  double e(std::size_t i) const { return pixels_[i].e; }

  /// 255 (E - e_min) / (e_max - e_min), not rounded.
  double intensity(std::size_t i, std::int64_t t_us) const {
    double e = pixels_[i].e;
    if (o_.readout_decay && pixels_[i].t_us) {
      e *= reference_gamma(o_.decay, seconds_between(*pixels_[i].t_us, t_us));
    }
    return 255.0 * (e - o_.e_min) / (o_.e_max - o_.e_min);
  }

 private:
  struct Pixel {
    double e = 0.0;
    std::optional<std::int64_t> t_us;
  };
  static double seconds_between(std::int64_t begin_us, std::int64_t end_us) {
    return static_cast<double>(end_us - begin_us) * 1e-6;
  }

  EsiOptions o_;
  std::size_t width_;
  std::vector<Pixel> pixels_;
};

/// The largest difference of E between the two, as a share of the clamp's range.
inline double largest_error(const Esi& esi, const EsiReference& reference, const EsiOptions& options) {
  double worst = 0.0;
  for (std::size_t i = 0; i < esi.pixels().size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(esi.pixels()[i].e) - reference.e(i)));
  }
  return worst / (options.e_max - options.e_min);
}

/// The largest distance of a grey level from the reference's intensity; 0.5 where all are rounded well.
inline double largest_grey_error(const cv::Mat1b& grey, const EsiReference& reference, std::int64_t t_us) {
  double worst = 0.0;
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(grey.cols) + static_cast<std::size_t>(x);
      worst = std::max(worst, std::abs(grey(y, x) - reference.intensity(i, t_us)));
    }
  }
  return worst;
}

}  // namespace esi::test
