#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "esi/core/phase.hpp"
#include "esi/sweep/sweep_config.hpp"

namespace esi {

/// A recording of a sweep, by what it holds: it may lie elsewhere the next time.
struct SweptRecording {
  std::string path, truth_path;
  std::int64_t events = 0;
  std::string crc32;        ///< of the events
  std::string truth_crc32;  ///< of the ground truth with its corners
  double duration_s = 0.0;
  std::vector<Phase> phases;
  SensorSize size;
  std::string lost;  ///< what was damaged and left out, in words; empty for nothing
};

/// What a sweep is: the first line of its store. Lines of stores with equal headers belong together.
struct SweepHeader {
  std::string version;  ///< of the program: another may find other tags
  SweepConfig config;
  std::vector<SweptRecording> recordings;
  std::map<std::string, std::string> files;  ///< that options name, such as times or weights: their CRC-32
};

/// "a.h5: 3 cut_line; b.h5: ..."; empty where nothing was lost.
std::string losses_of(const SweepHeader& header);

nlohmann::json to_json(const SweepHeader& header);

/// Throws an Error for what is no header.
SweepHeader header_from(const nlohmann::json& json);

/// Where the sweeps differ, in words, paths apart; empty where they are the same.
std::string difference(const nlohmann::json& a, const nlohmann::json& b);

/// Reads all recordings once, and their truths. Throws what esi-eval throws for truths and recordings that
/// don't go together. `runs` gets them with their truths loaded and what they lost.
SweepHeader survey(const SweepConfig& config, std::vector<InputRun>& runs, const Observer& observer);

}  // namespace esi
