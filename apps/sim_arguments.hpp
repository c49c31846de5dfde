#pragma once

#include <string>

#include "cli.hpp"

#include "esi/pipeline/sim_config.hpp"

namespace esi::cli {

/// What the command line of esi-sim says.
struct SimArguments {
  SimConfig config;
  std::string output;
  int threads = 1;
  RunningFlags running;
};

/// Fills `arguments`. Returns true when the tool should go on, else `exit_code` holds 0 or 2.
/// Throws a usage Error on values that can't be.
bool parse_sim_arguments(int argc, const char* const* argv, SimArguments& arguments, int& exit_code);

}  // namespace esi::cli
