#include "esi/sim/exposure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"
#include "esi/sim/random.hpp"

namespace esi {

void IntensityFrameOptions::declare(OptionTable& table) {
  table.toggle("intensity_frames", intensity_frames, "take the camera's own grey images, too");
  table.real("exposure_ms", exposure_ms, {0.1, 10000.0}, "ms", "their exposure (in low light 50 to 400)");
  table.real("frame_period_ms", frame_period_ms, {1.0, 60000.0}, "ms", "time from one exposure to the next");
  table.real("frame_full_scale", frame_full_scale, {0.01, 100.0}, "",
             "relative intensity that gives 255; 1 is a white surface");
  table.real("read_noise", read_noise, {0.0, 50.0}, "grey levels",
             "deviation of a pixel's reading; 0 is off");
}

void IntensityFrameOptions::check() const {
  if (exposure_ms <= frame_period_ms) return;
  throw usage_error(
      fmt::format("option exposure_ms: {} is longer than frame_period_ms {}", exposure_ms, frame_period_ms));
}

Exposure::Exposure(const IntensityFrameOptions& options, SensorSize size, std::int64_t end_us,
                   std::int64_t seed)
    : options_((options.check(), options)), size_(size), end_us_(end_us), seed_(seed) {
  light_us_.resize(static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px));
  expose_next();
}

void Exposure::expose_next() {
  const auto begin_us = std::llround(static_cast<double>(index_) * options_.frame_period_ms * 1e3);
  const Interval next{begin_us, begin_us + std::llround(options_.exposure_ms * 1e3)};
  interval_.reset();
  if (options_.intensity_frames && next.end_us <= end_us_) interval_ = next;
}

void Exposure::add(int y, std::span<const float> light, float weight_us) {
  float* const row = light_us_.data() + static_cast<std::size_t>(y) * light.size();
  for (std::size_t x = 0; x < light.size(); ++x) row[x] += weight_us * light[x];
}

IntensityFrame Exposure::read_out() {
  IntensityFrame frame{*interval_, cv::Mat1b(size_.height_px, size_.width_px)};
  const double scale = 255.0 / options_.frame_full_scale / static_cast<double>(interval_->duration_us());
  const RandomKey random(seed_, RandomStream::read_noise, static_cast<std::uint64_t>(index_));
  std::uint8_t* const out = frame.image.data;
  for (std::size_t i = 0; i < light_us_.size(); ++i) {
    const double noise = options_.read_noise > 0.0 ? options_.read_noise * random.normal(i) : 0.0;
    out[i] = static_cast<std::uint8_t>(std::lround(std::clamp(scale * light_us_[i] + noise, 0.0, 255.0)));
  }
  std::fill(light_us_.begin(), light_us_.end(), 0.0F);
  ++index_;
  expose_next();
  return frame;
}

}  // namespace esi
