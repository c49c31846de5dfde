#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/camera_calibration.hpp"
#include "esi/recon/reconstructor.hpp"
#include "esi/recon/steps/event_filters.hpp"
#include "esi/recon/steps/polarity_balance.hpp"
#include "esi/recon/steps/tone.hpp"
#include "esi/recon/steps/undistortion.hpp"

namespace esi {

/// Steps around a method, all off at first.
struct StepOptions {
  EventFilterOptions filters;
  BalanceOptions balance;
  SmoothingOptions smoothing;
  RangeOptions range;

  void declare(OptionTable& table);
};

/// What the steps need to know of the recording.
struct StepSurroundings {
  SensorSize size;                          ///< of what the method sees
  cv::Point corner;                         ///< its pixel in the whole sensor
  std::vector<cv::Point> hot_pixels;        ///< in the whole sensor's coordinates
  std::optional<CameraCalibration> camera;  ///< of the whole sensor; frames are undistorted where it is given
};

/// How many events each filter removed.
struct RemovedEvents {
  std::int64_t hot_pixels = 0;
  std::int64_t refractory = 0;
  std::int64_t background = 0;
};

/// Puts the chosen steps around a method: hot pixels, refractory and background filter and the polarity
/// balance before it, smoothing, range and undistortion after it, in this order. Returns the method itself
/// where none is chosen. `removed` is counted up, and must outlive the result. Throws a usage Error on
/// options that don't go together.
std::unique_ptr<Reconstructor> with_steps(std::unique_ptr<Reconstructor> method, const StepOptions& options,
                                          const StepSurroundings& surroundings, RemovedEvents& removed);

}  // namespace esi
