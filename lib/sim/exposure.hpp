#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/core/options.hpp"

namespace esi {

/// The camera's own images (APS frames).
struct IntensityFrameOptions {
  bool intensity_frames = true;
  double exposure_ms = 10.0;
  double frame_period_ms = 40.0;
  double frame_full_scale = 1.0;
  double read_noise = 2.0;

  void declare(OptionTable& table);
  /// Throws a usage Error where an exposure is longer than the period.
  void check() const;
};

/// Gathers light during exposures. Frame k is exposed from k * period on. Different threads may add different
/// rows.
class Exposure {
 public:
  /// Frames whose exposure would go beyond end_us are not taken. Throws a usage Error as check() does.
  Exposure(const IntensityFrameOptions& options, SensorSize size, std::int64_t end_us, std::int64_t seed);

  /// The next exposure that isn't finished.
  const std::optional<Interval>& interval() const { return interval_; }

  /// Adds the light of a row, with its weight in us.
  void add(int y, std::span<const float> light, float weight_us);

  /// At the end of interval(): the frame, read out with its noise.
  IntensityFrame read_out();

 private:
  void expose_next();

  IntensityFrameOptions options_;
  SensorSize size_;
  std::int64_t end_us_;
  std::int64_t seed_;
  std::int64_t index_ = 0;
  std::optional<Interval> interval_;
  std::vector<float> light_us_;  ///< gathered so far
};

}  // namespace esi
