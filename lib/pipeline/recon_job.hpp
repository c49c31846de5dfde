#pragma once

#include <filesystem>
#include <string>

#include "esi/pipeline/recon_config.hpp"
#include "esi/pipeline/reconstruct.hpp"

namespace esi {

/// One recording to be turned into one folder, video or stream.
struct ReconJob {
  std::filesystem::path recording;  ///< "-" is standard input
  std::filesystem::path output;     ///< see open_frame_sink
  int threads = 1;
  std::string tool;                          ///< who asks, for run.json
  std::filesystem::path motion_output = {};  ///< a folder for the image's motion; empty: none
};

struct ReconReport {
  Reconstruction result;
  Losses losses;
  SensorSize size;
  double wall_s = 0;
};

/// Opens, reconstructs, writes frames and the manifest. Throws an Error; what is on disk then doesn't claim
/// to be complete.
ReconReport run_job(const ReconJob& job, const ReconConfig& config, const Observer& observer = {});

}  // namespace esi
