#pragma once

#include <filesystem>

namespace esi {

// Beside the store and the results.
inline constexpr const char* kRunName = "run.json";            ///< the mark of the complete, written last
inline constexpr const char* kSweepConfigName = "sweep.json";  ///< for --config: the same sweep again

/// Makes the folder where it isn't there. Throws a usage Error for one that holds anything that no sweep
/// writes, and an Error with the system's reason.
void prepare_sweep_folder(const std::filesystem::path& folder);

}  // namespace esi
