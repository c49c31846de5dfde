#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/eval/score.hpp"
#include "esi/eval/statistics.hpp"
#include "esi/sweep/sweep_grid.hpp"

namespace esi {

/// What a cell reached in a phase, or in all of them.
struct SweepRate {
  Rate frames;                                  ///< with a tag found
  std::optional<ConfidenceInterval> bootstrap;  ///< of the rate; nothing for less than 2 blocks
  std::int64_t wrong = 0;                       ///< false detections
  std::optional<double> corner_error_px;        ///< mean; nothing where none was found or truth has none
};

struct CellOutcome {
  std::size_t cell = 0;                              ///< its number in the grid
  std::vector<SweepRate> phases;                     ///< of all recordings together, in SweepOutcome's order
  SweepRate total;                                   ///< of all phases
  std::vector<std::vector<SweepRate>> by_recording;  ///< [recording][phase]; reached in that one alone
  std::vector<SweepRate> totals;                     ///< [recording]
  PairedDifference to_best;                          ///< its rate less the best cell's, on frames of both
  std::optional<std::int64_t> dropped_after_round;   ///< by the search; such a cell saw fewer frames
};

/// What a sweep found.
struct SweepOutcome {
  SweepGrid grid;
  std::string method;
  std::string objective;  ///< the phase whose rate decides, "total" for all
  std::vector<std::string> recordings;
  std::vector<std::string> phases;  ///< names, each once, as they come up
  std::vector<CellOutcome> cells;   ///< all, in the grid's order
  std::size_t best = 0;             ///< see CellMerit
};

// A phase is its number in SweepOutcome::phases; that many stands for all phases together.

const SweepRate& rate_in(const CellOutcome& cell, std::size_t phase);
/// The phase that decides.
std::size_t objective_phase(const SweepOutcome& outcome);
/// Its name; "total" for all.
std::string phase_name(const SweepOutcome& outcome, std::size_t phase);

/// Whether some cells were dropped before they had seen all frames.
bool was_searched(const SweepOutcome& outcome);

/// Cells that differ from the best one in the axis' value alone, one for each value.
std::vector<std::size_t> slice_through_best(const SweepOutcome& outcome, std::size_t axis);

}  // namespace esi
