#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "esi/core/phase.hpp"
#include "esi/eval/score.hpp"

namespace esi {

/// What a cell did in one phase of a recording.
struct PhaseRecord {
  std::int64_t wrong = 0;        ///< false detections
  std::int64_t corners = 0;      ///< found tags whose error is known
  double corner_error_px = 0.0;  ///< their mean
};

/// What came of one cell on the frames of one recording that one round of the search looks at: a line of the
/// store.
struct CellRecord {
  std::size_t cell = 0, recording = 0;
  std::int64_t round = 0;
  std::vector<FrameScore> frames;   ///< those in a phase, by time
  std::vector<PhaseRecord> phases;  ///< one for each of the truth's
};

/// What a score says of a cell.
CellRecord cell_record(std::size_t cell, std::size_t recording, std::int64_t round, const Score& score);

/// {"cell": 3, "recording": 0, "round": 0, "frames": 620, "first_us": 0, "every_us": 100000, "detected":
/// "f3a...", "phases": [...]}; frames that aren't evenly spaced have "times_us" instead. In "detected" the
/// first frame is the highest bit of the first hex digit.
nlohmann::json to_json(const CellRecord& record);

/// Throws an Error for what is no such line. Frames are put into the phases by their times.
CellRecord record_from(const nlohmann::json& json, const std::vector<Phase>& phases);

}  // namespace esi
