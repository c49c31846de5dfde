#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"

namespace esi {

/// A method that turns events into grey images. It knows neither files nor clocks: whoever calls it decides
/// when a frame is due. Results don't depend on how events are cut into calls.
class Reconstructor {
 public:
  virtual ~Reconstructor() = default;

  /// Takes events that are sorted by time, inside the sensor, and not before those of earlier calls.
  virtual void process(std::span<const Event> events) = 0;

  /// Takes an intensity frame at its exposure's end. Methods that live on events alone ignore it.
  virtual void observe(const IntensityFrame& /*frame*/) {}

  /// The image at time t_us, after all events with t < t_us. `grey` is reallocated where it has another size.
  virtual void render(std::int64_t t_us, cv::Mat1b& grey) = 0;
};

}  // namespace esi
