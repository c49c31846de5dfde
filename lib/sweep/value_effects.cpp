#include "esi/sweep/value_effects.hpp"

#include <algorithm>
#include <numeric>

#include "esi/sweep/cell_ranking.hpp"

namespace esi {
namespace {

std::optional<double> in_points(const std::optional<double>& share) {
  return share ? std::optional(100.0 * *share) : std::nullopt;
}

std::optional<ConfidenceInterval> in_points(const std::optional<ConfidenceInterval>& shares) {
  if (!shares) return std::nullopt;
  return ConfidenceInterval{100.0 * shares->low, 100.0 * shares->high};
}

bool is_cost(const std::optional<double>& points, const std::optional<ConfidenceInterval>& points95) {
  return points && points95 && *points <= -kLeastEffectPoints && points95->high < 0.0;
}

}  // namespace

bool ValueEffect::costs() const { return is_cost(points, points95); }

std::vector<std::size_t> ascending_values(const SweepAxis& axis) {
  std::vector<std::size_t> order(axis.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (axis.numbers.empty()) return order;
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return axis.numbers[a] < axis.numbers[b]; });
  return order;
}

std::vector<ValueEffect> value_effects(const SweepOutcome& outcome, std::size_t axis_number) {
  const SweepAxis& axis = outcome.grid.axes()[axis_number];
  const std::vector<std::size_t> slice = slice_through_best(outcome, axis_number);
  const std::vector<std::size_t> anew = best_cells_of_values(outcome, axis_number);
  std::vector<ValueEffect> effects;
  for (const std::size_t value : ascending_values(axis)) {
    const PairedDifference& alone = outcome.cells[slice[value]].to_best;
    const PairedDifference& chosen = outcome.cells[anew[value]].to_best;
    ValueEffect& effect = effects.emplace_back();
    effect.value = axis.values[value] + (axis.unit.empty() ? "" : " " + axis.unit);
    effect.points = in_points(alone.difference);
    effect.points95 = in_points(alone.bootstrap);
    effect.anew_points = in_points(chosen.difference);
    effect.anew_costs = is_cost(effect.anew_points, in_points(chosen.bootstrap));
    effect.is_best = slice[value] == outcome.best;
  }
  return effects;
}

}  // namespace esi
