#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "esi/pipeline/recon_config.hpp"

namespace esi::cli {

/// What the command line of esi-recon says.
struct ReconArguments {
  std::vector<std::filesystem::path> recordings;  ///< folders are expanded
  std::string output;
  std::string flow_output;  ///< empty: none
  ReconConfig config;
  int threads = 1;
  int jobs = 1;
  bool quiet = false;
  bool info = false;
  bool check = false;  ///< with info
  bool json = false;
  bool list_methods = false;
  bool list_formats = false;
  bool print_config = false;
};

/// Fills `arguments`. Returns true when the tool should go on, else `exit_code` holds 0 or 2.
/// Throws a usage Error on values that can't be.
bool parse_recon_arguments(int argc, const char* const* argv, ReconArguments& arguments, int& exit_code);

}  // namespace esi::cli
