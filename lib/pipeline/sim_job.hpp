#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "esi/pipeline/progress.hpp"
#include "esi/pipeline/sim_config.hpp"

namespace esi {

/// One simulation to be written into one folder.
struct SimJob {
  std::filesystem::path output;
  int threads = 1;
  std::string tool;  ///< who asks, for run.json
};

struct SimReport {
  std::int64_t events = 0;
  std::int64_t intensity_frames = 0;
  std::int64_t t_us = 0;  ///< simulated
  double wall_s = 0.0;
  bool stopped = false;  ///< by the observer
};

/// Simulates and writes all that the config asks for; docs/simulator.md says what is written. run.json comes
/// last: without it the folder is not complete. Throws a usage Error on options that contradict one another
/// and on a folder that isn't free, before anything is written; an Error where something cannot be written.
SimReport run_job(const SimJob& job, const SimConfig& config, const Observer& observer = {});

}  // namespace esi
