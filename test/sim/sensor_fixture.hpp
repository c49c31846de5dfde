#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "esi/sim/pixel_array.hpp"

namespace esi::test {

/// A pixel without any noise, delay or variation.
inline SensorOptions ideal_sensor() {
  SensorOptions options;
  options.dark_current_lux = 0.0;
  options.lowpass = false;
  options.mismatch = 0.0;
  options.refractory_ms = 0.0;
  options.random_start = false;
  options.leak_hz = 0.0;
  options.shot_hz = 0.0;
  options.hot_share = 0.0;
  return options;
}

inline Camera camera_of(const std::string& sensor, const std::string& crop = "") {
  CameraOptions options;
  options.sensor = sensor;
  options.crop = crop;
  return Camera(options);
}

/// Relative intensity that all pixels see at a time in seconds.
using Light = std::function<double(double t_s)>;

/// Lets all pixels see the same light. Events come in order of steps, then rows.
inline std::vector<SensorEvent> record(PixelArray& pixels, SensorSize size, const Light& light,
                                       std::int32_t duration_us, std::int32_t step_us) {
  std::vector<float> row(static_cast<std::size_t>(size.width_px));
  const auto fill = [&](std::int32_t t_us) {
    row.assign(row.size(), static_cast<float>(light(1e-6 * t_us)));
  };
  fill(0);
  for (int y = 0; y < size.height_px; ++y) pixels.start(y, row);
  std::vector<SensorEvent> events;
  for (std::int32_t t_us = 0; t_us < duration_us; t_us += step_us) {
    fill(t_us + step_us);
    for (int y = 0; y < size.height_px; ++y) pixels.advance(y, row, {t_us, t_us + step_us}, events);
  }
  return events;
}

inline std::vector<SensorEvent> record(const SensorOptions& options, const std::string& sensor,
                                       const Light& light, std::int32_t duration_us, std::int32_t step_us,
                                       std::int64_t seed = 1) {
  const Camera camera = camera_of(sensor);
  PixelArray pixels(options, camera, seed);
  return record(pixels, camera.size, light, duration_us, step_us);
}

}  // namespace esi::test
