#include "esi/sweep/sweep_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/pipeline/evaluation/number_texts.hpp"
#include "esi/sweep/cell_ranking.hpp"

namespace esi {
namespace {

using Row = std::vector<std::string>;

std::string percent_text(const Rate& rate) {
  return rate.value() ? fmt::format("{:.1f}", 100.0 * *rate.value()) : "-";
}

void add_rate(Row& row, const SweepRate& rate) {
  row.push_back(std::to_string(rate.frames.of));
  row.push_back(std::to_string(rate.frames.hits));
  row.push_back(decimal_text(rate.frames.value(), 6));
  add_interval(row, rate.frames.wilson());
  add_interval(row, rate.bootstrap);
  row.push_back(std::to_string(rate.wrong));
  row.push_back(decimal_text(rate.corner_error_px, 4));
}

/// The rows of one cell.
class CellRows {
 public:
  CellRows(const SweepOutcome& outcome, const CellOutcome& cell, Table& table)
      : outcome_(outcome), cell_(cell), table_(table), start_{std::to_string(cell.cell)} {
    const std::vector<std::size_t> position = outcome.grid.position(cell.cell);
    for (std::size_t i = 0; i < position.size(); ++i) {
      start_.push_back(outcome.grid.axes()[i].values[position[i]]);
    }
  }

  void add() {
    for (std::size_t phase = 0; phase <= outcome_.phases.size(); ++phase) {
      add_row("all", phase, rate_in(cell_, phase), phase == objective_phase(outcome_));
    }
    if (outcome_.recordings.size() < 2) return;
    for (std::size_t i = 0; i < outcome_.recordings.size(); ++i) {
      for (std::size_t phase = 0; phase < outcome_.phases.size(); ++phase) {
        add_row(outcome_.recordings[i], phase, cell_.by_recording[i][phase], false);
      }
      add_row(outcome_.recordings[i], outcome_.phases.size(), cell_.totals[i], false);
    }
  }

 private:
  void add_row(const std::string& recording, std::size_t phase, const SweepRate& rate, bool is_compared) {
    Row& row = table_.rows.emplace_back(start_);
    row.push_back(recording);
    row.push_back(phase_name(outcome_, phase));
    add_rate(row, rate);
    row.push_back(is_compared ? decimal_text(cell_.to_best.difference, 6) : "");
    add_interval(row, is_compared ? cell_.to_best.bootstrap : std::nullopt);
    row.push_back(cell_.dropped_after_round ? std::to_string(*cell_.dropped_after_round) : "");
  }

  const SweepOutcome& outcome_;
  const CellOutcome& cell_;
  Table& table_;
  Row start_;
};

std::string points_text(const PairedDifference& difference) {
  if (!difference.difference) return "-";
  const std::string text = tenths_text(100.0 * *difference.difference);
  return difference.bootstrap ? fmt::format("{} ({})", text, percent_range_text(difference.bootstrap)) : text;
}

std::string caption_of(const SweepOutcome& outcome, std::size_t rows) {
  const std::size_t cells = outcome.cells.size();
  return fmt::format(
      "{}, the best first by the rate in {}. Rates in %; difference to the best cell in points on the same "
      "frames, with its 95 % interval.{}",
      rows < cells ? fmt::format("The best {} of {} cells", rows, cells) : fmt::format("All {} cells", cells),
      outcome.objective,
      was_searched(outcome) ? " Cells that the search dropped come last; they saw fewer frames." : "");
}

Row short_columns(const SweepOutcome& outcome) {
  Row columns = {"cell"};
  for (const SweepAxis& axis : outcome.grid.axes()) {
    if (axis.values.size() > 1) columns.push_back(axis.option);
  }
  columns.insert(columns.end(), outcome.phases.begin(), outcome.phases.end());
  for (const char* const column : {"total", "95 % (blocks)", "to the best", "false", "corner error, px"}) {
    columns.emplace_back(column);
  }
  if (was_searched(outcome)) columns.emplace_back("dropped after round");
  return columns;
}

Row short_row(const SweepOutcome& outcome, const CellOutcome& cell) {
  Row row = {std::to_string(cell.cell)};
  const std::vector<std::size_t> position = outcome.grid.position(cell.cell);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::vector<std::string>& values = outcome.grid.axes()[i].values;
    if (values.size() > 1) row.push_back(values[position[i]]);
  }
  for (const SweepRate& phase : cell.phases) row.push_back(percent_text(phase.frames));
  row.push_back(share_text(cell.total.frames));
  row.push_back(percent_range_text(cell.total.bootstrap));
  row.push_back(points_text(cell.to_best));
  row.push_back(std::to_string(cell.total.wrong));
  row.push_back(cell.total.corner_error_px ? decimal_text(cell.total.corner_error_px, 2) : "-");
  if (was_searched(outcome)) {
    row.push_back(cell.dropped_after_round ? std::to_string(*cell.dropped_after_round) : "-");
  }
  return row;
}

Row recording_row(const std::string& name, const std::vector<SweepRate>& phases, const SweepRate& total) {
  Row row = {name};
  for (const SweepRate& phase : phases) row.push_back(share_text(phase.frames));
  row.push_back(share_text(total.frames));
  row.push_back(percent_range_text(total.bootstrap));
  return row;
}

}  // namespace

Table sweep_rows(const SweepOutcome& outcome) {
  Table table{"", {"cell"}, {}};
  for (const SweepAxis& axis : outcome.grid.axes()) table.columns.push_back(axis.option);
  for (const char* const column :
       {"recording", "phase", "frames", "detected", "rate", "wilson_low", "wilson_high", "bootstrap_low",
        "bootstrap_high", "false_detections", "corner_error_mean_px", "difference_to_best", "difference_low",
        "difference_high", "dropped_after_round"}) {
    table.columns.emplace_back(column);
  }
  for (const CellOutcome& cell : outcome.cells) CellRows(outcome, cell, table).add();
  return table;
}

Table sweep_table(const SweepOutcome& outcome, std::size_t most_rows) {
  std::vector<std::size_t> ranked = ranked_cells(outcome);
  ranked.resize(std::min(ranked.size(), most_rows));
  Table table{caption_of(outcome, ranked.size()), short_columns(outcome), {}};
  for (const std::size_t cell : ranked) table.rows.push_back(short_row(outcome, outcome.cells[cell]));
  return table;
}

Table best_by_recording(const SweepOutcome& outcome) {
  Table table{"The best cell in each recording", {"recording"}, {}};
  table.columns.insert(table.columns.end(), outcome.phases.begin(), outcome.phases.end());
  table.columns.insert(table.columns.end(), {"total", "95 % (blocks)"});
  const CellOutcome& best = outcome.cells[outcome.best];
  for (std::size_t i = 0; i < outcome.recordings.size(); ++i) {
    table.rows.push_back(recording_row(outcome.recordings[i], best.by_recording[i], best.totals[i]));
  }
  table.rows.push_back(recording_row("all", best.phases, best.total));
  return table;
}

}  // namespace esi
