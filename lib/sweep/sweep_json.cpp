#include "esi/sweep/sweep_json.hpp"

#include <nlohmann/json.hpp>

#include "esi/pipeline/evaluation/rate_json.hpp"
#include "esi/sweep/main_effects.hpp"

namespace esi {
namespace {

using nlohmann::json;

json value_json(const SweepAxis& axis, std::size_t value) {
  return axis.numbers.empty() ? json(axis.values[value]) : json(axis.numbers[value]);
}

json axis_json(const SweepAxis& axis) {
  json values = json::array();
  for (std::size_t i = 0; i < axis.values.size(); ++i) values.push_back(value_json(axis, i));
  return {{"option", axis.option},
          {"unit", axis.unit},
          {"values", values},
          {"is_logarithmic", axis.is_logarithmic}};
}

json sweep_rate_json(const SweepRate& rate) {
  return {{"frames", rate_json(rate.frames)},
          {"bootstrap95", interval_json(rate.bootstrap)},
          {"false_detections", rate.wrong},
          {"corner_error_mean_px", or_null(rate.corner_error_px)}};
}

/// In the order of the sweep's phases.
json rates_json(const std::vector<SweepRate>& phases, const SweepRate& total) {
  json list = json::array();
  for (const SweepRate& phase : phases) list.push_back(sweep_rate_json(phase));
  return {{"phases", list}, {"total", sweep_rate_json(total)}};
}

json values_json(const SweepGrid& grid, std::size_t cell) {
  json values = json::object();
  const std::vector<std::size_t> position = grid.position(cell);
  for (std::size_t i = 0; i < position.size(); ++i) {
    values[grid.axes()[i].option] = value_json(grid.axes()[i], position[i]);
  }
  return values;
}

json cell_json(const SweepOutcome& outcome, const CellOutcome& cell) {
  json recordings = json::array();
  for (std::size_t i = 0; i < cell.by_recording.size(); ++i) {
    recordings.push_back(rates_json(cell.by_recording[i], cell.totals[i]));
  }
  return {{"cell", cell.cell},
          {"values", values_json(outcome.grid, cell.cell)},
          {"all", rates_json(cell.phases, cell.total)},
          {"recordings", recordings},
          {"to_best",
           {{"frames", cell.to_best.frames},
            {"difference", or_null(cell.to_best.difference)},
            {"bootstrap95", interval_json(cell.to_best.bootstrap)}}},
          {"dropped_after_round", or_null(cell.dropped_after_round)}};
}

}  // namespace

json to_json(const SweepOutcome& outcome) {
  json axes = json::array(), cells = json::array();
  for (const SweepAxis& axis : outcome.grid.axes()) axes.push_back(axis_json(axis));
  for (const CellOutcome& cell : outcome.cells) cells.push_back(cell_json(outcome, cell));
  return {{"method", outcome.method},
          {"objective", outcome.objective},
          {"grid", axes},
          {"recordings", outcome.recordings},
          {"phases", outcome.phases},
          {"main_effects", main_effects(outcome)},
          {"best", {{"cell", outcome.best}, {"values", values_json(outcome.grid, outcome.best)}}},
          {"cells", cells}};
}

}  // namespace esi
