#pragma once

#include <filesystem>
#include <vector>

#include "esi/sweep/sweep_queue.hpp"

namespace esi {

/// What one shard of a sweep has left in its folder.
struct SweepPart {
  std::filesystem::path folder;
  StoreContent content;
  SweepShard shard;
};

/// A folder without a store is left out, as a shard that never began; throws an Error where all are, and a
/// usage Error for stores of different sweeps.
std::vector<SweepPart> read_parts(const std::vector<std::filesystem::path>& folders);

/// Parts may have been made with other spellings of the recordings' paths; the shortest is taken, so that it
/// makes no difference which part was made how.
SweepHeader header_of(const std::vector<SweepPart>& parts);

/// The file with which the sweep can be made again; empty where no part has got that far.
std::filesystem::path config_of(const std::vector<SweepPart>& parts);

/// The shell command that makes these shards, each in its folder, or beside the others'.
std::string command_for(const std::vector<SweepPart>& parts, const std::vector<SweepShard>& shards);

}  // namespace esi
