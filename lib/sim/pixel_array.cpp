#include "esi/sim/pixel_array.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "esi/sim/float_math.hpp"
#include "esi/sim/random.hpp"

namespace esi {
namespace {

/// Pixels that are looked at in one go: their levels before the step stay in the L1 cache.
constexpr std::size_t kRun = 256;

/// No threshold falls below this share of the nominal one, however large the mismatch.
constexpr double kSmallestThreshold = 0.2;

}  // namespace

/// Within a step the level goes from `before` to level_[i] on a straight line.
struct PixelArray::Firing {
  std::size_t i;
  int x, y;
  float light;
  float before;
};

PixelArray::PixelArray(const SensorOptions& options, const Camera& camera, std::int64_t seed)
    : options_((options.check(), options)),
      size_(camera.size),
      origin_px_(camera.origin_px),
      seed_(seed),
      refractory_us_(static_cast<std::int32_t>(std::lround(options.refractory_ms * 1e3))),
      leak_per_us_(options.leak_hz * 1e-6) {
  const auto count = static_cast<std::size_t>(size_.width_px) * static_cast<std::size_t>(size_.height_px);
  for (auto* const field : {&log_light_, &level_, &memory_, &threshold_on_, &threshold_off_, &hot_hz_}) {
    field->resize(count);
  }
  t_event_us_.assign(count, -refractory_us_);
  t_noise_us_.resize(count);
  for (int y = 0; y < size_.height_px; ++y) {
    for (int x = 0; x < size_.width_px; ++x) make_pixel(x, y);
  }
}

std::uint64_t PixelArray::place_of(int x, int y) const {
  return static_cast<std::uint64_t>(origin_px_[1] + y) << 32 | static_cast<std::uint64_t>(origin_px_[0] + x);
}

void PixelArray::make_pixel(int x, int y) {
  const std::size_t i = index_of(x, y);
  const std::uint64_t place = place_of(x, y);
  const auto threshold = [&](double nominal, RandomStream stream) {
    const double drawn = nominal + options_.mismatch * RandomKey(seed_, stream).normal(place);
    return static_cast<float>(std::max(drawn, kSmallestThreshold * nominal));
  };
  threshold_on_[i] = threshold(options_.threshold_on(), RandomStream::on_mismatch);
  threshold_off_[i] = threshold(options_.threshold_off(), RandomStream::off_mismatch);
  const RandomKey hot(seed_, RandomStream::hot_pixel, place);
  if (hot.uniform(0) < options_.hot_share) {
    hot_hz_[i] = static_cast<float>(hot.uniform(1, options_.hot_min_hz, options_.hot_max_hz));
  }
  t_noise_us_[i] = NoiseSource(options_, seed_, place, hot_hz_[i]).next_us(0);
}

void PixelArray::start(int y, std::span<const float> light) {
  const auto dark = static_cast<float>(options_.dark_current_lux / options_.illuminance_lux);
  for (std::size_t x = 0; x < light.size(); ++x) {
    const std::size_t i = index_of(0, y) + x;
    log_light_[i] = level_[i] = memory_[i] = fast_log(light[x] + dark);
    if (!options_.random_start) continue;
    const RandomKey random(seed_, RandomStream::start, place_of(static_cast<int>(x), y));
    memory_[i] += static_cast<float>(random.uniform(0, -threshold_on_[i], threshold_off_[i]));
  }
}

void PixelArray::advance(int y, std::span<const float> light, TimeStep step,
                         std::vector<SensorEvent>& events) {
  std::array<float, kRun> before;
  std::array<std::uint32_t, kRun> may_fire;
  for (std::size_t begin = 0; begin < light.size(); begin += kRun) {
    const std::size_t count = std::min(kRun, light.size() - begin);
    const std::size_t first = index_of(0, y) + begin;
    std::copy_n(level_.data() + first, count, before.data());
    filter(first, light.subspan(begin, count), step);
    find_firing(first, step, std::span(may_fire).first(count));
    for (std::size_t j = 0; j < count; ++j) {
      if (may_fire[j] == 0) continue;
      fire({first + j, static_cast<int>(begin + j), y, light[begin + j], before[j]}, step, events);
    }
  }
}

/// Exact for a first-order low-pass whose input is a straight line within the step:
/// v1 = l1 - (l1 - l0) (1 - e) / x + (v0 - l0) e, with e = exp(-x), x = 2 pi cutoff duration.
void PixelArray::filter(std::size_t first, std::span<const float> light, TimeStep step) {
  const std::size_t count = light.size();
  const float* const __restrict in = light.data();
  float* const __restrict log_light = log_light_.data() + first;
  float* const __restrict level = level_.data() + first;
  const auto dark = static_cast<float>(options_.dark_current_lux / options_.illuminance_lux);
  if (!options_.lowpass) {
    for (std::size_t i = 0; i < count; ++i) log_light[i] = level[i] = fast_log(in[i] + dark);
    return;
  }
  const double per_hz = 2.0 * std::numbers::pi * 1e-6 * step.duration_us();
  const auto black = static_cast<float>(per_hz * options_.cutoff_dark_hz);
  const auto white = static_cast<float>(per_hz * options_.cutoff_white_hz);
  for (std::size_t i = 0; i < count; ++i) {
    const float l0 = log_light[i];
    const float l1 = fast_log(in[i] + dark);
    const float x = black + (white - black) * in[i];
    const float e = fast_exp_minus(x);
    level[i] = l1 - (l1 - l0) * ((1.0F - e) / x) + (level[i] - l0) * e;
    log_light[i] = l1;
  }
}

/// Marks the pixels that are beyond a threshold at the end of the step, or have a noise candidate within it.
void PixelArray::find_firing(std::size_t first, TimeStep step, std::span<std::uint32_t> may_fire) const {
  const std::size_t count = may_fire.size();
  std::uint32_t* const __restrict marks = may_fire.data();
  const float* const level = level_.data() + first;
  const float* const memory = memory_.data() + first;
  const float* const on = threshold_on_.data() + first;
  const float* const off = threshold_off_.data() + first;
  const std::int32_t* const t_event_us = t_event_us_.data() + first;
  const std::int32_t* const t_noise_us = t_noise_us_.data() + first;
  const auto leak_per_us = static_cast<float>(leak_per_us_);
  for (std::size_t i = 0; i < count; ++i) {
    const auto since_event_us = static_cast<float>(step.end_us - t_event_us[i]);
    const float difference = level[i] - memory[i] + leak_per_us * since_event_us * on[i];
    marks[i] = static_cast<std::uint32_t>(difference >= on[i]) |
               static_cast<std::uint32_t>(difference <= -off[i]) |
               static_cast<std::uint32_t>(t_noise_us[i] < step.end_us);
  }
}

void PixelArray::fire(const Firing& pixel, TimeStep step, std::vector<SensorEvent>& events) {
  const std::size_t i = pixel.i;
  const double on = threshold_on_[i], off = threshold_off_[i];
  const double leak = leak_per_us_ * on;
  const double climb = (static_cast<double>(level_[i]) - pixel.before) / step.duration_us();
  const auto level_at = [&](double t_us) { return pixel.before + climb * (t_us - step.begin_us); };
  const auto memory_at = [&](double t_us) { return memory_[i] - leak * (t_us - t_event_us_[i]); };
  for (;;) {
    const std::int32_t ready_us = std::max(step.begin_us, t_event_us_[i] + refractory_us_);
    const double difference = level_at(ready_us) - memory_at(ready_us);
    double crossing_us = ready_us;
    if (difference < on && difference > -off) {
      const double slope = climb + leak;
      const double way = slope > 0.0 ? on - difference : -off - difference;
      crossing_us = slope != 0.0 ? ready_us + way / slope : std::numeric_limits<double>::infinity();
    }
    if (t_noise_us_[i] < step.end_us && t_noise_us_[i] <= crossing_us) {
      add_noise(pixel, level_at(t_noise_us_[i]), events);
      continue;
    }
    if (crossing_us >= step.end_us) return;
    const auto t_us = static_cast<std::int32_t>(crossing_us);
    const bool is_on = difference >= on || (difference > -off && climb + leak > 0.0);
    memory_[i] = static_cast<float>(memory_at(t_us) + (is_on ? on : -off));
    t_event_us_[i] = t_us;
    events.push_back({t_us, static_cast<std::uint16_t>(pixel.x), static_cast<std::uint16_t>(pixel.y), is_on,
                      EventCause::signal});
  }
}

/// A noise event makes the pixel forget: it memorises the present level (as in v2e and IEBCS).
void PixelArray::add_noise(const Firing& pixel, double level, std::vector<SensorEvent>& events) {
  const std::size_t i = pixel.i;
  const std::int32_t t_us = t_noise_us_[i];
  const NoiseSource source(options_, seed_, place_of(pixel.x, pixel.y), hot_hz_[i]);
  t_noise_us_[i] = source.next_us(t_us);
  if (t_us < t_event_us_[i] + refractory_us_) return;
  const auto event = source.draw(t_us, pixel.light);
  if (!event) return;
  memory_[i] = static_cast<float>(level);
  t_event_us_[i] = t_us;
  events.push_back({t_us, static_cast<std::uint16_t>(pixel.x), static_cast<std::uint16_t>(pixel.y), event->on,
                    event->cause});
}

}  // namespace esi
