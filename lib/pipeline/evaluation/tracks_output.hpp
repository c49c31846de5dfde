#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "esi/pipeline/evaluation/results.hpp"

namespace esi {

/// "track_<input>_<method>.tum" and "truth_<input>.tum", both numbers from 0 on.
bool is_track_name(std::string_view name);

/// The target's position relative to the camera along the world's axes, as TUM lines without rotation, for
/// each method that was tracked, and the true one beside it: what `evo_ape tum truth_0.tum track_0_1.tum`
/// compares.
void write_tracks(const std::filesystem::path& folder, const Evaluation& evaluation,
                  const std::vector<InputResult>& results);

}  // namespace esi
