#include "esi/recon/accumulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// A narrower range of V would make grey levels of rounding errors.
constexpr double kLeastRange = 0.001;

/// Where nothing has happened yet there is nothing to decay, and times may be any 64 bits.
template <class Decay>
double decayed(double v, std::int64_t from_us, std::int64_t to_us, const Decay& decay) {
  return v == 0.0 ? 0.0 : decay(v, to_us - from_us);
}

}  // namespace

void AccumulatorOptions::declare(OptionTable& table) {
  table.choice("decay", decay, {"exponential", "linear", "step", "none"},
               "how V returns to v_neutral: as exp(-dt/tau); by slope; at once after the step time; not");
  table.real("tau_s", tau_s, {0.001, 1e6}, "s", "time constant of the exponential decay");
  table.real("slope_hz", slope_hz, {0.0, 1e6}, "1/s", "slope of the linear decay");
  table.real("step_s", step_s, {0.0, 1e6}, "s", "the step decay forgets a pixel that rested for longer");
  table.real("contribution", contribution, {0.0001, 1000.0}, "",
             "what an ON event adds to V and an OFF event takes from it");
  table.real("v_min", v_min, {-1e6, 1e6}, "", "lower bound of the potential V, shown black");
  table.real("v_max", v_max, {-1e6, 1e6}, "", "upper bound of V, shown white");
  table.real("v_neutral", v_neutral, {-1e6, 1e6}, "", "where V begins and what it decays to");
  table.toggle("readout_decay", readout_decay, "decay V to the frame's time before it is shown");
}

void AccumulatorOptions::check() const {
  if (v_max - v_min >= kLeastRange && v_min <= v_neutral && v_neutral <= v_max) return;
  throw usage_error(
      fmt::format("v_min {}, v_neutral {} and v_max {}: write v_min <= v_neutral <= v_max, with "
                  "the bounds at least {} apart",
                  v_min, v_neutral, v_max, kLeastRange));
}

Accumulator::Accumulator(const AccumulatorOptions& options, SensorSize size)
    : options_(options), size_(size), loss_(1.0 / options.tau_s), pixels_(size, {}, "accumulator") {
  options_.check();
}

template <class Use>
void Accumulator::with_decay(Use use) const {
  switch (options_.decay) {
    case AccumulatorDecay::exponential:
      return use([this](double v, std::int64_t dt_us) { return v - v * loss_(dt_us); });
    case AccumulatorDecay::linear:
      return use([slope_per_us = options_.slope_hz * 1e-6](double v, std::int64_t dt_us) {
        return std::copysign(std::max(std::abs(v) - slope_per_us * static_cast<double>(dt_us), 0.0), v);
      });
    case AccumulatorDecay::step:
      return use([step_us = std::llround(options_.step_s * 1e6)](double v, std::int64_t dt_us) {
        return dt_us > step_us ? 0.0 : v;
      });
    case AccumulatorDecay::none:
      return use([](double v, std::int64_t /*dt_us*/) { return v; });
  }
}

void Accumulator::take(std::span<const Event> events, std::span<const float> weights) {
  if (events.empty()) return;
  const double low = options_.v_min - options_.v_neutral;
  const double high = options_.v_max - options_.v_neutral;
  with_decay([&](const auto& decay) {
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Event& event = events[i];
      const double weight = weights.empty() ? 1.0 : static_cast<double>(weights[i]);
      const double added = weight * (event.on ? options_.contribution : -options_.contribution);
      Pixel& pixel = pixels_.at(event);
      const double v = decayed(pixel.v, pixel.t_us, event.t_us, decay) + added;
      pixel = {std::clamp(v, low, high), event.t_us};
    }
  });
  t_last_us_ = events.back().t_us;
}

// DV decays its state at readout. That comes to the same: a decay in two parts is one of both times together.
void Accumulator::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  levels.create(size_.height_px, size_.width_px);
  const double scale = 255.0 / (options_.v_max - options_.v_min);
  const double offset = (options_.v_neutral - options_.v_min) * scale;
  const auto show = [&](const auto& decay) {
    for (int y = 0; y < levels.rows; ++y) {
      const Pixel* const pixels = pixels_.row(y);
      float* const shown = levels[y];
      for (int x = 0; x < levels.cols; ++x) {
        const Pixel& pixel = pixels[x];
        shown[x] = static_cast<float>(decayed(pixel.v, pixel.t_us, t_us, decay) * scale + offset);
      }
    }
  };
  if (!options_.readout_decay) return show([](double v, std::int64_t /*dt_us*/) { return v; });
  t_us = std::max(t_us, t_last_us_);
  with_decay(show);
}

}  // namespace esi
