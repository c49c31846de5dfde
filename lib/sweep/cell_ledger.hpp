#pragma once

#include <string>
#include <vector>

#include "esi/eval/score.hpp"
#include "esi/sweep/cell_record.hpp"
#include "esi/sweep/sweep_header.hpp"

namespace esi {

/// What a cell reached on one recording in all rounds so far.
struct CellTally {
  std::vector<FrameScore> frames;   ///< by time
  std::vector<PhaseRecord> phases;  ///< one for each of the truth's; empty before anything is known
};

/// What is known of every cell, in whatever order it came.
class CellLedger {
 public:
  CellLedger(std::size_t cells, const std::vector<SweptRecording>& recordings);

  void add(const CellRecord& record);

  const CellTally& tally(std::size_t cell, std::size_t recording) const {
    return tallies_[cell * recordings_.size() + recording];
  }

  /// Its frames of all recordings on one clock, recordings one after another; only those of phases of that
  /// name, or with "total" all. For comparing cells frame by frame.
  Score joined(std::size_t cell, const std::string& phase) const;

  /// Detected frames of these, and false detections and corner errors of their phases.
  Rate rate(std::size_t cell, const std::string& phase) const;
  PhaseRecord faults(std::size_t cell, const std::string& phase) const;

 private:
  bool counts(std::size_t recording, std::size_t phase, const std::string& name) const;

  const std::vector<SweptRecording>& recordings_;
  std::vector<CellTally> tallies_;
};

/// Together: counts add up, means are weighted.
PhaseRecord sum_of(const PhaseRecord& a, const PhaseRecord& b);

/// The best of some cells for `objective` (see CellMerit), which are at least one.
std::size_t best_cell(const CellLedger& ledger, const std::vector<std::size_t>& cells,
                      const std::string& objective);

/// Those of some in the order from best to worst.
std::vector<std::size_t> ranked(const CellLedger& ledger, std::vector<std::size_t> cells,
                                const std::string& objective);

}  // namespace esi
