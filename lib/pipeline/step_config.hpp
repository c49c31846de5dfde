#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "esi/core/event.hpp"
#include "esi/io/read_options.hpp"
#include "esi/pipeline/crop.hpp"
#include "esi/recon/steps/stepped_reconstructor.hpp"

namespace esi {

/// The steps around a method, as they are asked for.
struct StepConfig {
  StepOptions steps;
  std::string undistort;  ///< a camera's calibration, or empty

  void declare(OptionTable& table);
  bool any() const;
  /// Throws a usage Error on options that don't go together.
  void check() const;
};

/// Finds out what the chosen steps need: reads the calibration, and the whole recording where hot pixels are
/// to be learnt. `sensor` is the whole sensor, of which the region is reconstructed. Throws a usage Error for
/// hot pixels outside the sensor or learnt from standard input, and for a calibration of another camera.
StepSurroundings surroundings_of(const StepConfig& config, const std::filesystem::path& recording,
                                 const ReadOptions& read, SensorSize sensor,
                                 const std::optional<Region>& region);

/// {"hot_pixels": "x,y x,y", "removed": {"hot_pixels": 0, ...}} of the chosen filters: for run.json.
nlohmann::json steps_json(const StepConfig& config, const StepSurroundings& surroundings,
                          const RemovedEvents& removed);

}  // namespace esi
