// Tables against counts of their own.
#include "esi/pipeline/evaluation/result_tables.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "esi/pipeline/evaluation/cost.hpp"
#include "pipeline/evaluation/made_runs.hpp"

using namespace esi;
using namespace esi::test;

namespace {

/// A table's cell by the column's name.
std::string cell(const Table& table, std::size_t row, const std::string& column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  REQUIRE(found != table.columns.end());
  REQUIRE(row < table.rows.size());
  REQUIRE(table.rows[row].size() == table.columns.size());
  return table.rows[row][static_cast<std::size_t>(found - table.columns.begin())];
}

/// Two inputs with one name in common with the pooled result's, two methods, three phases, one of them empty.
Evaluation made() {
  const std::vector<Detection> found = {tag_at(0, 10)}, both = {tag_at(0, 10), tag_at(1, 50)};
  const std::vector<Detection> foreign = {tag_at(9, 10)}, twice = {tag_at(0, 10), tag_at(0, 80)};
  const std::vector<Phase> phases = {{"a", {0, 30'000}}, {"b", {30'000, 60'000}}, {"c", {60'000, 70'000}}};
  Evaluation evaluation;
  evaluation.inputs = {made_input("all", phases, {0, 1},
                                  {made_run("esi", 0, {found, {}, both, foreign, twice, {}}),
                                   made_run("other", 0, {{}, {}, {}, {}, found, {}})}),
                       made_input("second", phases, {0, 1},
                                  {made_run("esi", 0, {{}, {}, {}, {}, {}, {}}),
                                   made_run("other", 0, {both, {}, both, {}, {}, {}, {}, {}})})};
  return evaluation;
}

}  // namespace

TEST_CASE("the table has what a count over frames and detections gives") {
  const Evaluation evaluation = made();
  const auto results = results_of(evaluation, {});
  REQUIRE(results.size() == 3);
  const Table table = score_rows(results), frames = frame_rows(evaluation, results);
  const Table detections = detection_rows(evaluation, "tag36h11");
  using Key = std::array<std::string, 3>;
  std::map<Key, std::pair<int, int>> counts;
  std::map<Key, int> foreign, tags;
  std::map<std::array<std::string, 3>, std::string> phase_of;
  for (std::size_t i = 0; i < frames.rows.size(); ++i) {
    const std::string input = cell(frames, i, "input"), method = cell(frames, i, "method");
    const std::string phase = cell(frames, i, "phase");
    phase_of[{input, method, cell(frames, i, "frame")}] = phase;
    if (phase.empty()) continue;
    for (const auto& key : {Key{input, method, phase}, Key{input, method, "total"}}) {
      counts[key].first += cell(frames, i, "detected") == "1" ? 1 : 0;
      ++counts[key].second;
    }
  }
  std::set<std::array<std::string, 4>> seen;
  for (std::size_t i = 0; i < detections.rows.size(); ++i) {
    const std::string input = cell(detections, i, "input"), method = cell(detections, i, "method");
    const std::string id = cell(detections, i, "id"), frame = cell(detections, i, "frame");
    const std::string phase = phase_of.at({input, method, frame});
    if (phase.empty()) continue;
    if (id == "9") ++foreign[{input, method, phase}];
    if (id != "9" && seen.insert({input, method, frame, id}).second) ++tags[{input, method, phase}];
  }
  int rows = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Key key = {cell(table, i, "input"), cell(table, i, "method"), cell(table, i, "phase")};
    if (i < 8) continue;  // those of all together, which has an input's name here
    CAPTURE(key[0], key[1], key[2]);
    const auto [hits, of] = counts[key];
    CHECK(cell(table, i, "frames") == std::to_string(of));
    CHECK(cell(table, i, "detected") == std::to_string(hits));
    CHECK(cell(table, i, "rate").empty() == (of == 0));
    CHECK(cell(table, i, "wilson_low").empty() == (of == 0));
    CHECK(cell(table, i, "reason").empty() == (of > 0));
    if (of > 0) CHECK(std::stod(cell(table, i, "rate")) == Approx(double(hits) / of).margin(1e-6));
    if (key[2] == "total") continue;
    CHECK(cell(table, i, "false_foreign") == std::to_string(foreign[key]));
    CHECK(cell(table, i, "tags_found") == std::to_string(tags[key]));
    ++rows;
  }
  CHECK(rows == 12);
  CHECK(table.rows.size() == 8 + 16);
  CHECK(cell(table, 3, "phase") == "total");
  CHECK(cell(table, 3, "frames") == "12");  // pooled
  CHECK(cell(table, 3, "detected") == "3");
  CHECK(cell(table, 8 + 1, "false_duplicate") == "1");
}

TEST_CASE("frames of no phase have an empty one, and are not detected in it") {
  const Evaluation evaluation = made();
  const Table frames = frame_rows(evaluation, results_of(evaluation, {}));
  REQUIRE(frames.rows.size() == 6 + 6 + 6 + 8);
  CHECK(cell(frames, 24, "phase") == "c");
  CHECK(cell(frames, 25, "phase").empty());
  CHECK(cell(frames, 25, "detected") == "0");
  CHECK(cell(frames, 25, "t_us") == "70000");
}

TEST_CASE("the people's table has a column a phase and a row a method") {
  const Evaluation evaluation = made();
  const Table table = rate_table(results_of(evaluation, {})[1]);
  CHECK(table.caption == "all");
  REQUIRE(table.rows.size() == 2);
  CHECK(cell(table, 0, "a") == "2/3 (66.7 %)");
  CHECK(cell(table, 0, "b") == "1/3 (33.3 %)");
  CHECK(cell(table, 0, "c") == "-");
  CHECK(cell(table, 0, "total") == "3/6 (50.0 %)");
  CHECK(cell(table, 0, "false") == "2");
  CHECK(cell(table, 0, "tags") == "4/12 (33.3 %)");
}

TEST_CASE("each id has rows of its own") {
  const Evaluation evaluation = made();
  const Table table = tag_rows(results_of(evaluation, {}));
  CHECK(table.rows.size() == 3 * 2 * 4 * 2);
  const std::size_t first = 2 * 4 * 2;  // after those of all together
  CHECK(cell(table, first, "id") == "0");
  CHECK(cell(table, first, "tags_found") == "2");
  CHECK(cell(table, first, "tag_chances") == "3");
  CHECK(cell(table, first + 1, "id") == "1");
  CHECK(cell(table, first + 1, "tags_found") == "1");
  CHECK(cell(table, first + 1, "first_found_s") == "0.020000");
}

TEST_CASE("costs are those of the frames, and empty where nothing was reconstructed") {
  const auto cost = frame_cost({1.0, 4.0, 2.0, 3.0});
  REQUIRE(cost);
  CHECK(cost->mean_ms == 2.5);
  CHECK(cost->median_ms == 2.5);
  CHECK(cost->p95_ms == Approx(3.85));
  CHECK(cost->max_ms == 4.0);
  CHECK(cost->sum_s == Approx(0.010));
  CHECK_FALSE(frame_cost({}));

  Evaluation evaluation = made();
  InputRun& input = evaluation.inputs[0];
  input.duration_s = 0.05;
  input.digest.emplace();
  const std::vector<Event> events(2000);
  input.digest->add(events);
  input.methods[0].reconstruction_ms = {1.0, 1.0, 2.0, 1.0};
  input.methods[0].detection_ms = {3.0, 5.0};
  const Table table = cost_rows(evaluation, 2, 1.5);
  REQUIRE(table.rows.size() == 4);
  CHECK(cell(table, 0, "events") == "2000");
  CHECK(cell(table, 0, "mev_s") == "0.400");  // 2000 events in 5 ms
  CHECK(cell(table, 0, "times_real_time") == "10.000");
  CHECK(cell(table, 0, "frames_per_s") == "120.000");
  CHECK(cell(table, 0, "reconstruction_ms_mean") == "1.2500");
  CHECK(cell(table, 0, "reconstruction_ms_max") == "2.0000");
  CHECK(cell(table, 0, "detection_ms_median") == "4.0000");
  CHECK(cell(table, 0, "threads") == "2");
  CHECK(cell(table, 0, "wall_s") == "1.500");
  CHECK(std::stod(cell(table, 0, "peak_memory_mb")) > 1.0);
  CHECK(cell(table, 1, "mev_s").empty());
  CHECK(cell(table, 1, "reconstruction_ms_mean").empty());
  CHECK(cell(table, 2, "frames_per_s").empty());
}
