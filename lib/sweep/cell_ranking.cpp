#include "esi/sweep/cell_ranking.hpp"

#include <algorithm>
#include <numeric>

#include "esi/sweep/cell_merit.hpp"

namespace esi {

ShownRate shown_rate(const SweepOutcome& outcome, const CellOutcome& cell, std::size_t phase) {
  const SweepRate& own = rate_in(cell, phase);
  ShownRate shown{own.frames.value(), own.bootstrap};
  const std::optional<double> best = rate_in(outcome.cells[outcome.best], phase).frames.value();
  if (!cell.dropped_after_round || phase != objective_phase(outcome)) return shown;
  if (!shown.rate || !best || !cell.to_best.difference) return shown;
  const double moved = *best + *cell.to_best.difference - *shown.rate;
  const auto share = [&](double value) { return std::clamp(value + moved, 0.0, 1.0); };
  shown.rate = share(*shown.rate);
  if (shown.bootstrap)
    shown.bootstrap = ConfidenceInterval{share(shown.bootstrap->low), share(shown.bootstrap->high)};
  return shown;
}

bool ranks_before(const SweepOutcome& outcome, const CellOutcome& a, const CellOutcome& b) {
  const bool is_dropped = a.dropped_after_round.has_value();
  if (is_dropped != b.dropped_after_round.has_value()) return !is_dropped;
  const std::size_t phase = objective_phase(outcome);
  const auto merit = [&](const CellOutcome& cell) {
    const SweepRate& rate = rate_in(cell, phase);
    return CellMerit{shown_rate(outcome, cell, phase).rate, rate.wrong, rate.corner_error_px, cell.cell};
  };
  return is_better(merit(a), merit(b));
}

std::vector<std::size_t> ranked_cells(const SweepOutcome& outcome) {
  std::vector<std::size_t> ranked(outcome.cells.size());
  std::iota(ranked.begin(), ranked.end(), std::size_t{0});
  std::sort(ranked.begin(), ranked.end(), [&](std::size_t a, std::size_t b) {
    return ranks_before(outcome, outcome.cells[a], outcome.cells[b]);
  });
  return ranked;
}

std::vector<std::size_t> best_cells_of_values(const SweepOutcome& outcome, std::size_t axis) {
  std::vector<std::optional<std::size_t>> best(outcome.grid.axes()[axis].values.size());
  for (const CellOutcome& cell : outcome.cells) {
    auto& found = best[outcome.grid.position(cell.cell)[axis]];
    if (!found || ranks_before(outcome, cell, outcome.cells[*found])) found = cell.cell;
  }
  std::vector<std::size_t> cells;
  cells.reserve(best.size());
  for (const auto& found : best) cells.push_back(found.value_or(outcome.best));
  return cells;
}

void HighestRate::add(const CellOutcome& cell, const ShownRate& rate) {
  if (!rate.rate) return;
  std::optional<double>& highest = cell.dropped_after_round ? dropped_ : whole_;
  highest = std::max(highest.value_or(0.0), *rate.rate);
}

}  // namespace esi
