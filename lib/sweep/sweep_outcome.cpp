#include "esi/sweep/sweep_outcome.hpp"

#include <algorithm>

namespace esi {

const SweepRate& rate_in(const CellOutcome& cell, std::size_t phase) {
  return phase < cell.phases.size() ? cell.phases[phase] : cell.total;
}

std::size_t objective_phase(const SweepOutcome& outcome) {
  if (outcome.objective == "total") return outcome.phases.size();
  const auto found = std::find(outcome.phases.begin(), outcome.phases.end(), outcome.objective);
  return static_cast<std::size_t>(found - outcome.phases.begin());
}

std::string phase_name(const SweepOutcome& outcome, std::size_t phase) {
  return phase < outcome.phases.size() ? outcome.phases[phase] : "total";
}

bool was_searched(const SweepOutcome& outcome) {
  return std::any_of(outcome.cells.begin(), outcome.cells.end(),
                     [](const CellOutcome& cell) { return cell.dropped_after_round.has_value(); });
}

std::vector<std::size_t> slice_through_best(const SweepOutcome& outcome, std::size_t axis) {
  std::vector<std::size_t> position = outcome.grid.position(outcome.best), slice;
  for (std::size_t value = 0; value < outcome.grid.axes()[axis].values.size(); ++value) {
    position[axis] = value;
    slice.push_back(outcome.grid.cell(position));
  }
  return slice;
}

}  // namespace esi
