#pragma once

#include <string>
#include <vector>

#include "esi/sweep/sweep_queue.hpp"
#include "esi/sweep/sweep_results.hpp"

// A sweep without recordings: which frames would be detected is made up.

namespace esi::test {

/// 12 cells on two recordings.
inline SweepHeader header_of(SearchOptions::Search search = SearchOptions::Search::full) {
  SweepHeader header;
  header.version = "test";
  header.config.add_axis(parse_axis("tau_s=1:6:1"));
  header.config.add_axis(parse_axis("n=1,2"));
  header.config.search.search = search;
  header.config.search.first_stride = 4;
  for (const char* const path : {"a.h5", "b.h5"}) {
    header.recordings.push_back(
        {path, "truth.json", 10, "00000000", "00000000", 40.0, {{"all", {0, 40'000'000}}}, {346, 260}, ""});
  }
  return header;
}

/// A made-up truth: cell 7 is best by far; 4 to 6 are as good on the frames of the first round alone. A frame
/// a second, of those that the round shares out.
inline std::vector<CellRecord> records_of(const SweepBlock& block) {
  std::vector<CellRecord> records;
  for (const std::size_t cell : block.cells) {
    CellRecord& record = records.emplace_back();
    record = {cell, block.recording, block.round, {}, {PhaseRecord{}}};
    for (std::int64_t i = block.frames.first; i < 40; i += block.frames.stride) {
      const bool is_deceptive = cell >= 4 && cell <= 6;
      const bool is_detected =
          cell == 7 || (is_deceptive ? i % 4 == 0 : (i * 7) % 12 < static_cast<int>(cell));
      record.frames.push_back({i * 1'000'000, 0, is_detected});
    }
  }
  return records;
}

inline void work_off(SweepQueue& queue, double seconds = 10.0) {
  while (const auto block = queue.next()) queue.finish(*block, records_of(*block), seconds);
}

inline std::string rates_in(const SweepOutcome& outcome) {
  std::string text;
  for (const CellOutcome& cell : outcome.cells) {
    text += std::to_string(cell.total.frames.hits) + "/" + std::to_string(cell.total.frames.of) + " ";
  }
  return text + "best " + std::to_string(outcome.best);
}

}  // namespace esi::test
