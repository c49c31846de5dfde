#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "esi/report/heat_map.hpp"
#include "esi/sweep/cell_ranking.hpp"
#include "esi/sweep/sweep_figures.hpp"
#include "esi/sweep/value_effects.hpp"

namespace esi {
namespace {

constexpr std::size_t kMostHeatMaps = 60;
/// Larger ones are neither read nor drawn well.
constexpr std::size_t kMostValuesOfHeatMap = 50;

using AxisPair = std::pair<std::size_t, std::size_t>;

bool is_drawable(const SweepAxis& axis) {
  return axis.values.size() > 1 && axis.values.size() <= kMostValuesOfHeatMap;
}

std::vector<AxisPair> axis_pairs(const SweepGrid& grid) {
  std::vector<AxisPair> pairs;
  for (std::size_t a = 0; a < grid.axes().size(); ++a) {
    for (std::size_t b = a + 1; b < grid.axes().size(); ++b) {
      if (is_drawable(grid.axes()[a]) && is_drawable(grid.axes()[b])) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

bool shows_phases(const SweepOutcome& outcome) {
  // One phase is the same as all.
  return outcome.phases.size() > 1 &&
         axis_pairs(outcome.grid).size() * (outcome.phases.size() + 1) <= kMostHeatMaps;
}

/// The number of each value's row or column.
std::vector<std::size_t> places_of(const SweepAxis& axis) {
  std::vector<std::size_t> places(axis.values.size());
  const std::vector<std::size_t> order = ascending_values(axis);
  for (std::size_t place = 0; place < order.size(); ++place) places[order[place]] = place;
  return places;
}

std::vector<std::string> names_of(const SweepAxis& axis) {
  std::vector<std::string> names;
  for (const std::size_t value : ascending_values(axis)) names.push_back(axis.values[value]);
  return names;
}

HeatMap heat_map_of(const SweepOutcome& outcome, const AxisPair& pair, std::size_t phase) {
  const SweepAxis &x = outcome.grid.axes()[pair.first], &y = outcome.grid.axes()[pair.second];
  const std::vector<std::size_t> x_places = places_of(x), y_places = places_of(y);
  std::vector<std::vector<HighestRate>> highest(y.values.size(), std::vector<HighestRate>(x.values.size()));
  for (const CellOutcome& cell : outcome.cells) {
    const std::vector<std::size_t> position = outcome.grid.position(cell.cell);
    highest[y_places[position[pair.second]]][x_places[position[pair.first]]].add(
        cell, shown_rate(outcome, cell, phase));
  }
  HeatMap map{axis_label(x), axis_label(y), fmt::format("rate in {}, %", phase_name(outcome, phase)),
              names_of(x),   names_of(y),   {}};
  for (const auto& row : highest) {
    std::vector<double>& values = map.values.emplace_back();
    for (const HighestRate& rate : row) values.push_back(rate.value() ? 100.0 * *rate.value() : NAN);
  }
  const std::vector<std::size_t> best = outcome.grid.position(outcome.best);
  map.outlined = HeatMap::Place{x_places[best[pair.first]], y_places[best[pair.second]]};
  return map;
}

std::string caption_of(const SweepOutcome& outcome, const AxisPair& pair, std::size_t phase) {
  const auto& axes = outcome.grid.axes();
  std::string others;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i == pair.first || i == pair.second || axes[i].values.size() < 2) continue;
    others += (others.empty() ? "" : ", ") + axes[i].option;
  }
  return fmt::format("{} and {}, {}: {}. The best cell is outlined.", axes[pair.first].option,
                     axes[pair.second].option, phase_name(outcome, phase),
                     others.empty() ? "the rate" : "the best rate over the values of " + others);
}

std::string name_of(const SweepOutcome& outcome, const AxisPair& pair, std::size_t phase) {
  std::string name = figure_name(outcome.grid.axes()[pair.first].option) + "-" +
                     figure_name(outcome.grid.axes()[pair.second].option);
  if (phase == outcome.phases.size()) return name;
  return fmt::format("{}-{}-{}", name, phase + 1, figure_name(outcome.phases[phase]));
}

}  // namespace

std::vector<SweepFigure> heat_map_figures(const SweepOutcome& outcome) {
  const std::size_t total = outcome.phases.size();
  std::vector<SweepFigure> figures;
  for (const AxisPair& pair : axis_pairs(outcome.grid)) {
    const auto add = [&](std::size_t phase) {
      if (rate_in(outcome.cells[outcome.best], phase).frames.of == 0) return;
      figures.push_back({name_of(outcome, pair, phase), caption_of(outcome, pair, phase),
                         heat_map(heat_map_of(outcome, pair, phase))});
    };
    add(total);
    for (std::size_t phase = 0; phase < total && shows_phases(outcome); ++phase) add(phase);
  }
  return figures;
}

std::string left_out_heat_maps(const SweepOutcome& outcome) {
  std::string text;
  if (outcome.phases.size() > 1 && !shows_phases(outcome)) {
    text = fmt::format(
        "Heat maps are of all phases together: with those of each phase there would be more than {}.",
        kMostHeatMaps);
  }
  for (const SweepAxis& axis : outcome.grid.axes()) {
    if (axis.values.size() <= kMostValuesOfHeatMap) continue;
    text += fmt::format("{}There are none with {}, which has more than {} values.", text.empty() ? "" : " ",
                        axis.option, kMostValuesOfHeatMap);
  }
  return text;
}

}  // namespace esi
