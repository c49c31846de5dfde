#pragma once

#include "recon_arguments.hpp"

namespace esi::cli {

/// Reconstructs every recording of the command line, some at the same time. One that fails does not stop the
/// rest. Several get a folder each below the output, and a summary.csv. Returns the worst exit code.
int run_batch(const ReconArguments& arguments);

}  // namespace esi::cli
