#pragma once

#include <filesystem>
#include <vector>

#include "cli.hpp"

#include "esi/sweep/sweep_job.hpp"

namespace esi::cli {

/// What the command line of esi-sweep says.
struct SweepArguments {
  SweepJob job;
  SweepConfig config;
  RunningFlags running;
  bool plan = false;
  std::vector<std::filesystem::path> shards;  ///< to be merged; empty for a sweep
};

/// Fills `arguments`. Returns true when the tool should go on, else `exit_code` holds 0 or 2.
/// Throws a usage Error on values that can't be.
bool parse_sweep_arguments(int argc, const char* const* argv, SweepArguments& arguments, int& exit_code);

}  // namespace esi::cli
