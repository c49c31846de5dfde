#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "esi/core/packet.hpp"
#include "esi/pipeline/sim_config.hpp"
#include "esi/sim/simulator.hpp"

namespace esi {

/// One kind of file that is written while a simulation runs.
class SimOutput {
 public:
  /// Without finish() nothing of it passes for whole.
  virtual ~SimOutput() = default;

  /// The simulator's latest packet. What is true of any time up to simulator.t_us() can be written, too.
  virtual void take(const Simulator& simulator, const Packet& packet) = 0;
  virtual void finish() = 0;
};

/// All that the options ask for, into an empty folder.
std::vector<std::unique_ptr<SimOutput>> open_sim_outputs(const std::filesystem::path& folder,
                                                         const Simulator& simulator, const SimConfig& config);

// The kinds. Each throws an Error where its files cannot be made.

/// events.h5, events.aedat4 or events.txt; beside text calib.txt.
std::unique_ptr<SimOutput> open_recording_output(const std::filesystem::path& folder,
                                                 const std::string& extension, const Simulator& simulator);

/// corners.csv, camera.tum, target.tum, and at the end ground_truth.json.
std::unique_ptr<SimOutput> open_truth_output(const std::filesystem::path& folder, const Simulator& simulator,
                                             const SimOutputOptions& options);

/// exposures.csv, and where no recording holds the pictures, frames/.
std::unique_ptr<SimOutput> open_frames_output(const std::filesystem::path& folder, bool with_pictures);

/// clean/
std::unique_ptr<SimOutput> open_clean_output(const std::filesystem::path& folder, double fps);

/// labels.u8
std::unique_ptr<SimOutput> open_label_output(const std::filesystem::path& folder);

/// preview.mp4
std::unique_ptr<SimOutput> open_preview_output(const std::filesystem::path& folder, SensorSize size,
                                               double fps);

}  // namespace esi
