#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

/// A rate as figures show it.
struct ShownRate {
  std::optional<double> rate;
  std::optional<ConfidenceInterval> bootstrap;
};

/// The cell's own rate. A cell that the search dropped saw fewer frames, perhaps easier ones: in the phase
/// that decides, its rate is the best cell's plus the difference to it on frames of both.
ShownRate shown_rate(const SweepOutcome& outcome, const CellOutcome& cell, std::size_t phase);

/// Whether `a` is better: cells that saw all frames first, then by the rate that decides; of equal ones the
/// fewest false detections, then the smallest corner error, then the first in the grid.
bool ranks_before(const SweepOutcome& outcome, const CellOutcome& a, const CellOutcome& b);

/// Numbers of all cells, the best first.
std::vector<std::size_t> ranked_cells(const SweepOutcome& outcome);

/// For each of the axis' values the best of all cells that have it.
std::vector<std::size_t> best_cells_of_values(const SweepOutcome& outcome, std::size_t axis);

/// The highest of several cells' rates: of those that saw all frames where there are such, else of the
/// others.
class HighestRate {
 public:
  void add(const CellOutcome& cell, const ShownRate& rate);
  std::optional<double> value() const { return whole_ ? whole_ : dropped_; }

 private:
  std::optional<double> whole_, dropped_;
};

}  // namespace esi
