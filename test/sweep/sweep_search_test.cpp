#include "esi/sweep/sweep_search.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

using namespace esi;

namespace {

SearchOptions halving(std::int64_t first_stride) {
  SearchOptions options;
  options.search = SearchOptions::Search::halving;
  options.first_stride = first_stride;
  return options;
}

std::vector<SweptRecording> recording_of(double duration_s) {
  SweptRecording recording;
  recording.duration_s = duration_s;
  recording.phases = {{"all", {0, us_from_seconds(duration_s)}}};
  return {recording};
}

/// A frame a second; `missed(i)` says which are not detected.
template <class Missed>
CellRecord record_of(std::size_t cell, std::int64_t count, Missed missed) {
  CellRecord record{cell, 0, 0, {}, {PhaseRecord{}}};
  for (std::int64_t i = 0; i < count; ++i) record.frames.push_back({i * 1'000'000, 0, !missed(i)});
  return record;
}

std::vector<std::size_t> all_cells(std::size_t count) {
  std::vector<std::size_t> cells(count);
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  return cells;
}

}  // namespace

TEST_CASE("Rounds of halving share all frames out, each once, a full search has them in one round") {
  for (const std::int64_t stride : {1, 3}) {
    for (const std::int64_t first : {1, 2, 16}) {
      const SweepSearch search(halving(first), {}, stride);
      std::map<std::int64_t, int> looked_at;
      std::int64_t seen = 0;
      for (std::int64_t round = 0; round < search.rounds(); ++round) {
        const FrameShare share = search.frames(round);
        const std::int64_t before = seen;
        for (std::int64_t i = 0; i < 48 * stride; ++i) {
          if (i % share.stride == share.first) ++looked_at[i], ++seen;
        }
        if (round > 0) CHECK(seen == 2 * before);
      }
      CHECK(seen == 48);
      for (const auto& [frame, times] : looked_at) {
        CHECK(frame % stride == 0);
        CHECK(times == 1);
      }
    }
  }
  SearchOptions full = halving(16);
  full.search = SearchOptions::Search::full;
  CHECK(SweepSearch(full, {}, 2).rounds() == 1);
  CHECK(SweepSearch(full, {}, 2).frames(0).stride == 2);
}

TEST_CASE("At most the better half of the cells goes on, the best always") {
  const auto recordings = recording_of(100);
  CellLedger ledger(8, recordings);
  for (std::size_t cell = 0; cell < 8; ++cell) {  // other frames, nearly as many: differences can't be told
    const auto misses = 30 - static_cast<std::int64_t>(cell), shift = 59 * static_cast<std::int64_t>(cell);
    ledger.add(record_of(cell, 100, [&](std::int64_t i) { return (i * 37 + shift) % 101 < misses; }));
  }
  const SweepSearch search(halving(16), {}, 1);
  CHECK(search.survivors(ledger, all_cells(8), 0, 8) == std::vector<std::size_t>{4, 5, 6, 7});
  CHECK(search.survivors(ledger, all_cells(8), 1, 8) == std::vector<std::size_t>{6, 7});
  CHECK(search.survivors(ledger, all_cells(8), 4, 8) == std::vector<std::size_t>{6});
  // Where few are left anyway, none is dropped that isn't certainly worse.
  CHECK(search.survivors(ledger, {2, 5, 6}, 1, 8) == std::vector<std::size_t>{5, 6});
  CHECK(search.survivors(ledger, {5, 6}, 1, 8) == std::vector<std::size_t>{5, 6});
  CHECK(search.survivors(ledger, {3}, 2, 8) == std::vector<std::size_t>{3});
}

TEST_CASE("A cell that is certainly worse doesn't go on, even in the better half") {
  const auto recordings = recording_of(100);
  CellLedger ledger(4, recordings);
  ledger.add(record_of(0, 100, [](std::int64_t) { return false; }));
  ledger.add(record_of(1, 100, [](std::int64_t i) { return i % 3 == 0; }));
  ledger.add(record_of(2, 100, [](std::int64_t i) { return i % 2 == 0; }));
  ledger.add(record_of(3, 100, [](std::int64_t) { return true; }));
  CHECK(SweepSearch(halving(2), {}, 1).survivors(ledger, all_cells(4), 0, 4) == std::vector<std::size_t>{0});
}

TEST_CASE("Equal rates are told apart by false detections, then corner error, then the grid's order") {
  const auto recordings = recording_of(10);
  CellLedger ledger(4, recordings);
  const std::vector<PhaseRecord> faults{{2, 5, 0.1}, {0, 5, 0.7}, {0, 5, 0.3}, {0, 5, 0.3}};
  for (std::size_t cell = 0; cell < 4; ++cell) {
    CellRecord record = record_of(cell, 10, [](std::int64_t i) { return i == 3; });
    record.phases = {faults[cell]};
    ledger.add(record);
  }
  CHECK(ranked(ledger, all_cells(4), "total") == std::vector<std::size_t>{2, 3, 1, 0});
}

TEST_CASE("Cells are compared in the phase that decides") {
  std::vector<SweptRecording> recordings = recording_of(10);
  recordings[0].phases = {{"a", {0, 5'000'000}}, {"b", {5'000'000, 10'000'000}}};
  CellLedger ledger(2, recordings);
  for (std::size_t cell = 0; cell < 2; ++cell) {
    CellRecord record = record_of(cell, 10, [&](std::int64_t i) { return cell == 0 ? i == 4 : i > 7; });
    for (FrameScore& frame : record.frames) frame.phase = frame.t_us < 5'000'000 ? 0 : 1;
    record.phases = {PhaseRecord{}, PhaseRecord{}};
    ledger.add(record);
  }
  CHECK(best_cell(ledger, {0, 1}, "total") == 0);
  CHECK(best_cell(ledger, {0, 1}, "a") == 1);
  CHECK(best_cell(ledger, {0, 1}, "b") == 0);
  CHECK(ledger.rate(1, "b").hits == 3);
  CHECK(ledger.rate(1, "b").of == 5);
}
