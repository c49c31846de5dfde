#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/sim/camera.hpp"
#include "esi/sim/noise_source.hpp"
#include "esi/sim/sensor_event.hpp"
#include "esi/sim/sensor_options.hpp"

namespace esi {

/// The pixels of an event camera: intensity + dark current -> log -> low-pass -> comparison with the
/// memorised level -> events. Rows don't know of one another: different threads may advance different rows.
/// What is random about a pixel depends on the seed and on its place on the whole sensor alone.
class PixelArray {
 public:
  /// Throws a usage Error as SensorOptions::check() does.
  PixelArray(const SensorOptions& options, const Camera& camera, std::int64_t seed);

  /// Settles a row on the light it sees at time 0.
  void start(int y, std::span<const float> light);

  /// Takes a row to the end of a step, when it sees `light` (relative intensity, 1 for white); in between log
  /// intensity went on a straight line. Appends its events, pixel by pixel, each pixel's in order of time.
  void advance(int y, std::span<const float> light, TimeStep step, std::vector<SensorEvent>& events);

  double threshold_on(int x, int y) const { return threshold_on_[index_of(x, y)]; }
  double threshold_off(int x, int y) const { return threshold_off_[index_of(x, y)]; }

 private:
  /// A pixel that may fire in this step.
  struct Firing;

  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width_px) +
           static_cast<std::size_t>(x);
  }
  std::uint64_t place_of(int x, int y) const;
  void make_pixel(int x, int y);
  void filter(std::size_t first, std::span<const float> light, TimeStep step);
  void find_firing(std::size_t first, TimeStep step, std::span<std::uint32_t> may_fire) const;
  void fire(const Firing& pixel, TimeStep step, std::vector<SensorEvent>& events);
  void add_noise(const Firing& pixel, double level, std::vector<SensorEvent>& events);

  SensorOptions options_;
  SensorSize size_;
  cv::Vec2i origin_px_;
  std::int64_t seed_;
  std::int32_t refractory_us_;
  double leak_per_us_;            ///< in ON thresholds
  std::vector<float> log_light_;  ///< at the end of the last step
  std::vector<float> level_;      ///< the same after the low-pass
  std::vector<float> memory_;     ///< at the last event; leaks since then
  std::vector<float> threshold_on_;
  std::vector<float> threshold_off_;
  std::vector<float> hot_hz_;
  std::vector<std::int32_t> t_event_us_;  ///< last event
  std::vector<std::int32_t> t_noise_us_;  ///< next candidate for a noise event
};

}  // namespace esi
