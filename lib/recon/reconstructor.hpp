#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/core/worker_pool.hpp"

namespace esi {

/// A method that turns events into grey images. It knows neither files nor clocks: whoever calls it decides
/// when a frame is due. Results don't depend on how events are cut into calls.
class Reconstructor {
 public:
  virtual ~Reconstructor() = default;

  /// Takes events that are sorted by time, inside the sensor, and not before those of earlier calls.
  /// `weights` say how much each event counts, as a factor of what the method adds for it: one a piece, or
  /// none at all, and every event counts 1.
  void process(std::span<const Event> events, std::span<const float> weights = {}) { take(events, weights); }

  /// Takes an intensity frame at its exposure's end. Methods that live on events alone ignore it.
  virtual void observe(const IntensityFrame& /*frame*/) {}

  /// Grey levels at time t_us, after all events with t < t_us: 0 is shown black and 255 white, but they are
  /// neither rounded nor clamped. `levels` is reallocated where it has another size.
  virtual void render_levels(std::int64_t t_us, cv::Mat1f& levels) = 0;

  /// The same as an image: levels rounded and clamped.
  virtual void render(std::int64_t t_us, cv::Mat1b& grey);

  /// How the image moves where the last frame was made: px per second, right and down, at every pixel.
  /// nullptr for methods that don't estimate motion, which is so from the first call on.
  virtual const cv::Mat2f* motion() { return nullptr; }

  /// Lends the workers of a pool that belongs to the calling thread, as this method does. The results are the
  /// same. Methods that have no use for them ignore it.
  virtual void use_workers(std::shared_ptr<WorkerPool> /*workers*/) {}

 private:
  virtual void take(std::span<const Event> events, std::span<const float> weights) = 0;

  cv::Mat1f levels_;
};

}  // namespace esi
