// Tables against counts of their own.
#include "esi/sweep/sweep_tables.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "sweep/made_sweep.hpp"

using namespace esi;
using namespace esi::test;

namespace {

using Cells = std::map<std::string, std::string>;

/// A row by its columns' names.
Cells row_of(const Table& table, std::size_t row) {
  REQUIRE(table.rows.at(row).size() == table.columns.size());
  Cells cells;
  for (std::size_t i = 0; i < table.columns.size(); ++i) cells[table.columns[i]] = table.rows[row][i];
  REQUIRE(cells.size() == table.columns.size());
  return cells;
}

/// Fields of CSV lines, as RFC 4180 has them.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += c, ++i;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!is_quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

std::int64_t counted(const std::vector<std::size_t>& position, const std::string& recording,
                     const std::string& phase) {
  std::int64_t hits = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    if (phase != "total" && phase != (p == 0 ? "straight" : kEvilPhase)) continue;
    if (recording != "second.aedat4") hits += usual_hits(position, p);
    if (recording != kEvilRecording) hits += usual_hits(position, p) - 2;
  }
  return hits;
}

}  // namespace

TEST_CASE("the sweep's table has every cell, recording and phase with the counts of its own") {
  const SweepOutcome outcome = usual_sweep();
  const Table table = sweep_rows(outcome);
  REQUIRE(table.rows.size() == 16 * 3 * 4);
  std::set<std::array<std::string, 3>> seen;
  std::int64_t best_hits = 0;
  for (std::size_t cell = 0; cell < 16; ++cell) {
    best_hits = std::max(best_hits, counted(outcome.grid.position(cell), "all", "total"));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Cells row = row_of(table, i);
    seen.insert({row["cell"], row["recording"], row["phase"]});
    const auto position = outcome.grid.position(std::stoul(row["cell"]));
    for (std::size_t a = 0; a < 4; ++a) {
      CHECK(row[usual_axes()[a].option] == usual_axes()[a].values[position[a]]);
    }
    CAPTURE(row["cell"], row["recording"], row["phase"]);
    const bool is_compared = row["recording"] == "all" && row["phase"] == "total";
    CHECK(row["difference_to_best"].empty() != is_compared);
    CHECK(row["difference_low"].empty() != is_compared);
    CHECK(row["dropped_after_round"].empty());
    if (row["phase"] == "never") {
      CHECK(row["frames"] == "0");
      for (const char* const column :
           {"rate", "wilson_low", "wilson_high", "bootstrap_low", "bootstrap_high", "corner_error_mean_px"}) {
        CHECK(row[column].empty());
      }
      continue;
    }
    const std::int64_t hits = counted(position, row["recording"], row["phase"]);
    const std::int64_t of =
        kMadeFrames * (row["phase"] == "total" ? 2 : 1) * (row["recording"] == "all" ? 2 : 1);
    CHECK(row["frames"] == std::to_string(of));
    CHECK(row["detected"] == std::to_string(hits));
    CHECK(row["false_detections"] == std::to_string(of - hits));
    const double share = static_cast<double>(hits) / static_cast<double>(of);
    CHECK(std::stod(row["rate"]) == Approx(share).margin(1e-6));
    CHECK(std::stod(row["bootstrap_low"]) == Approx(share - 0.03).margin(1e-6));
    CHECK(std::stod(row["bootstrap_high"]) == Approx(std::min(1.0, share + 0.04)).margin(1e-6));
    CHECK(std::stod(row["wilson_low"]) < share);
    CHECK(std::stod(row["wilson_high"]) > share);
    CHECK(std::stod(row["corner_error_mean_px"]) == Approx(1.0 - 0.5 * share).margin(1e-4));
    if (!is_compared || std::stoul(row["cell"]) == outcome.best) continue;
    const double difference = static_cast<double>(hits - best_hits) / 4000.0;
    CHECK(std::stod(row["difference_to_best"]) == Approx(difference).margin(1e-6));
    CHECK(std::stod(row["difference_low"]) == Approx(difference - 0.005).margin(1e-6));
    CHECK(std::stod(row["difference_high"]) == Approx(difference + 0.005).margin(1e-6));
  }
  CHECK(seen.size() == table.rows.size());
}

TEST_CASE("the sweep's CSV reads back as it was, whatever names hold") {
  const Table table = sweep_rows(usual_sweep());
  const auto rows = parsed_csv(to_csv(table));
  REQUIRE(rows.size() == table.rows.size() + 1);
  CHECK(rows.front() == table.columns);
  CHECK(std::equal(table.rows.begin(), table.rows.end(), rows.begin() + 1));
}

TEST_CASE("one recording stands as all, and the difference with the phase that decides") {
  SweepOutcome outcome = usual_sweep();
  outcome.objective = "straight";
  outcome.recordings.pop_back();
  const Table table = sweep_rows(outcome);
  REQUIRE(table.rows.size() == 16 * 4);
  CHECK(row_of(table, 0)["phase"] == "straight");
  CHECK_FALSE(row_of(table, 0)["difference_to_best"].empty());
  CHECK(row_of(table, 3)["phase"] == "total");
  CHECK(row_of(table, 3)["difference_to_best"].empty());
}

TEST_CASE("the short table has the best cells first, and only what was varied") {
  const Table table = sweep_table(usual_sweep(), 3);
  CHECK(table.columns == std::vector<std::string>{"cell", "tau_s", "form", "readout_decay", "straight",
                                                  kEvilPhase, "never", "total", "95 % (blocks)",
                                                  "to the best", "false", "corner error, px"});
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[0] == std::vector<std::string>{"12", "4", "exponential", "true", "91.3", "81.3", "-",
                                                  "3452/4000 (86.3 %)", "83.3..90.3", "0.0 (0.0..0.0)", "548",
                                                  "0.57"});
  CHECK(row_of(table, 1)["to the best"] == "-0.2 (-0.7..0.3)");
  CHECK(table.rows[1][0] == "8");
  CHECK(table.rows[2][0] == "13");
  CHECK_THAT(table.caption,
             Catch::StartsWith("The best 3 of 16 cells, the best first by the rate in total."));
  CHECK_THAT(sweep_table(usual_sweep(), 99).caption, Catch::StartsWith("All 16 cells"));
}

TEST_CASE(
    "of cells of one rate that with the fewest false detections is first, then the smallest corner error") {
  SweepOutcome outcome =
      made_sweep({made_numbers("n", "", {"1", "2", "3", "4", "5"})},
                 [](const auto& position, std::size_t) { return position[0] == 4 ? 499 : 500; });
  outcome.cells[2].total.wrong -= 1;
  outcome.cells[3].total.wrong -= 1;
  outcome.cells[3].total.corner_error_px = 0.1;
  outcome.cells[4].total.wrong = 0;
  std::vector<std::string> order;
  for (const auto& row : sweep_table(outcome, 9).rows) order.push_back(row[0]);
  CHECK(order == std::vector<std::string>{"3", "2", "0", "1", "4"});
}

TEST_CASE(
    "cells that the search dropped come last, by their difference to the best, whatever rate they had") {
  SweepOutcome outcome = usual_sweep();
  drop(outcome, 8, 2);
  drop(outcome, 0, 1);
  const Table table = sweep_table(outcome, 99);
  REQUIRE(table.columns.back() == "dropped after round");
  CHECK(table.rows[15][0] == "0");
  CHECK(table.rows[15].back() == "1");
  CHECK(table.rows[14][0] == "8");
  CHECK(table.rows[14].back() == "2");
  CHECK(table.rows[0].back() == "-");
  CHECK_THAT(table.caption, Catch::Contains("dropped come last"));
  const Cells row = row_of(sweep_rows(outcome), 8 * 3 * 4 + 3);
  CHECK(row.at("frames") == "2000");
  CHECK(row.at("dropped_after_round") == "2");
}

TEST_CASE("what the best cell reached stands for each recording and all") {
  const Table table = best_by_recording(usual_sweep());
  REQUIRE(table.rows.size() == 3);
  CHECK(row_of(table, 0)["recording"] == kEvilRecording);
  CHECK(row_of(table, 0)["straight"] == "914/1000 (91.4 %)");
  CHECK(row_of(table, 1)["straight"] == "912/1000 (91.2 %)");
  CHECK(row_of(table, 2)["total"] == "3452/4000 (86.3 %)");
  CHECK(row_of(table, 2)["never"] == "-");
}

TEST_CASE("what rounds to nothing has no sign") {
  SweepOutcome outcome = usual_sweep();
  outcome.cells[8].to_best = {100, -0.0002, ConfidenceInterval{-0.0004, 0.0003}};
  CHECK(row_of(sweep_table(outcome, 2), 1)["to the best"] == "0.0 (0.0..0.0)");
}
