#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "esi/io/output/run_manifest.hpp"
#include "esi/sweep/cell_record.hpp"
#include "esi/sweep/sweep_header.hpp"

namespace esi {

/// Writes everything that a complete sweep's records say into its folder, run.json last. Returns the result
/// in a few lines for people.
std::string write_results(const std::filesystem::path& folder, const std::string& tool,
                          const SweepHeader& header, const std::vector<CellRecord>& records,
                          const RunManifest::Run& run);

}  // namespace esi
