#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

struct SweepFile {
  std::string name;  ///< within the sweep's folder: "curves/tau_s.png"
  std::string bytes;
};

/// table.csv, table.md, table.tex, table.json, best.json, report.html, curves/OPTION.png and
/// heat_maps/OPTION-OPTION[-PHASE].png. The same outcome gives the same bytes. `how` tells how the numbers
/// were made, a paragraph a line.
std::vector<SweepFile> sweep_files(const SweepOutcome& outcome, const nlohmann::json& best_config,
                                   const std::string& how);

/// Writes them, each whole or not at all. Throws an Error with the path and the system's reason.
void write_sweep_files(const std::filesystem::path& folder, const SweepOutcome& outcome,
                       const nlohmann::json& best_config, const std::string& how);

// What a sweep's folder may hold of these.
bool is_sweep_file(std::string_view name);
bool is_sweep_folder(std::string_view name);

}  // namespace esi
