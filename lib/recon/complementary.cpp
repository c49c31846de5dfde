#include "esi/recon/complementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/recon/intensity.hpp"

namespace esi {
namespace {

/// A narrower display would make grey levels of rounding errors.
constexpr double kLeastRange = 0.01;
/// Brighter than 20 000 times white is shown as that, so that grey levels stay within an int.
constexpr double kMostLevel = 10.0;
/// A frame's pixels are trusted fully where their share of white keeps this far from 0 and 1.
constexpr double kMargin = 0.05;
/// What is left of the cutoff frequency at black and at white.
constexpr double kLeastShare = 0.1;

/// log(1 + I) of mid-grey: the reference as long as there is no intensity frame.
const float kNeutral = static_cast<float>(std::log(1.5));

/// Falls from 1 at the margins to kLeastShare at black and at white, along L (not along I).
float trust(double l) {
  const double to_black = l / std::log1p(kMargin);
  const double to_white = (std::numbers::ln2 - l) / (std::numbers::ln2 - std::log(2.0 - kMargin));
  const double trusted = std::clamp(std::min(to_black, to_white), 0.0, 1.0);
  return static_cast<float>(kLeastShare + trusted * (1.0 - kLeastShare));
}

}  // namespace

void HighPassOptions::declare(OptionTable& table) {
  table.real("cutoff_hz", cutoff_hz, {0.0, 1000.0}, "Hz",
             "cutoff frequency: L decays to its reference at a rate of 2 pi times this");
  table.real("c_on", c_on, {0.0001, 10.0}, "", "what an ON event adds to L");
  table.real("c_off", c_off, {0.0001, 10.0}, "", "what an OFF event takes from L");
  table.real("show_min", show_min, {-1.0, 1000.0}, "", "the exp(L) - 1 that is shown black");
  table.real("show_max", show_max, {-1.0, 1000.0}, "", "the exp(L) - 1 that is shown white");
}

void HighPassOptions::check() const {
  if (show_max - show_min >= kLeastRange) return;
  throw usage_error(fmt::format("show_min {} and show_max {}: show_max must be larger by at least {}",
                                show_min, show_max, kLeastRange));
}

void ComplementaryOptions::declare(OptionTable& table) {
  HighPassOptions::declare(table);
  table.toggle("spare_saturated", spare_saturated,
               "lower the cutoff frequency where an intensity frame is under- or overexposed");
}

Complementary::Complementary(const ComplementaryOptions& options, SensorSize size, std::string_view method)
    : options_(options),
      size_(size),
      loss_(2.0 * std::numbers::pi * options.cutoff_hz),
      pixels_(size, {.l = static_cast<double>(kNeutral), .reference = kNeutral}, method),
      t_last_us_(std::numeric_limits<std::int64_t>::min()) {
  options_.check();
}

// L <- exp(-alpha dt) L + (1 - exp(-alpha dt)) reference
double Complementary::level_at(const Pixel& pixel, std::int64_t t_us) const {
  const double from_reference = pixel.l - static_cast<double>(pixel.reference);
  if (from_reference == 0.0) return pixel.l;
  const std::int64_t dt_us = t_us - pixel.t_us;
  if (pixel.cutoff_share == 1.0F) return pixel.l - from_reference * loss_(dt_us);
  const double rate_per_us =
      2e-6 * std::numbers::pi * options_.cutoff_hz * static_cast<double>(pixel.cutoff_share);
  return pixel.l + from_reference * std::expm1(-rate_per_us * static_cast<double>(dt_us));
}

void Complementary::take(std::span<const Event> events, std::span<const float> weights) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event& event = events[i];
    const double weight = weights.empty() ? 1.0 : static_cast<double>(weights[i]);
    Pixel& pixel = pixels_.at(event);
    pixel.l = level_at(pixel, event.t_us) + weight * (event.on ? options_.c_on : -options_.c_off);
    pixel.t_us = event.t_us;
  }
  if (!events.empty()) t_last_us_ = events.back().t_us;
}

void Complementary::observe(const IntensityFrame& frame) {
  const cv::Mat1f shares = relative_intensity(frame, size_, "complementary");
  t_last_us_ = std::max(t_last_us_, frame.exposure.end_us);
  for (int y = 0; y < shares.rows; ++y) {
    Pixel* const pixels = pixels_.row(y);
    for (int x = 0; x < shares.cols; ++x) {
      Pixel& pixel = pixels[x];
      pixel.l = level_at(pixel, t_last_us_);  // up to now it decayed to the last frame
      pixel.t_us = t_last_us_;
      const double reference = std::log1p(static_cast<double>(shares(y, x)));
      pixel.reference = static_cast<float>(reference);
      if (options_.spare_saturated) pixel.cutoff_share = trust(reference);
    }
  }
}

void Complementary::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  t_us = std::max(t_us, t_last_us_);
  levels.create(size_.height_px, size_.width_px);
  for (int y = 0; y < levels.rows; ++y) {
    const Pixel* const pixels = pixels_.row(y);
    float* const shown = levels[y];
    for (int x = 0; x < levels.cols; ++x) {
      shown[x] = static_cast<float>(std::min(level_at(pixels[x], t_us), kMostLevel));
    }
  }
  cv::exp(levels, levels);
  const double scale = 255.0 / (options_.show_max - options_.show_min);
  levels.convertTo(levels, CV_32F, scale, -(1.0 + options_.show_min) * scale);
}

}  // namespace esi
