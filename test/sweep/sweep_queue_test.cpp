#include "esi/sweep/sweep_queue.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <thread>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"
#include "sweep/made_work.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using namespace esi::test;

TEST_CASE("Every cell is handed out once on every recording, in blocks of one recording") {
  const TempFolder folder;
  const SweepHeader header = header_of();
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {1, 5, 60.0});
  std::set<std::pair<std::size_t, std::size_t>> seen;
  while (const auto block = queue.next()) {
    CHECK(block->cells.size() <= 5);
    for (const std::size_t cell : block->cells) CHECK(seen.insert({cell, block->recording}).second);
    queue.finish(*block, records_of(*block), 1.0);
  }
  CHECK(seen.size() == 24);
  CHECK(queue.is_complete());
  CHECK(store.records().size() == 24);
  CHECK(outcome_of(header, store.records()).best == 7);
  CHECK(missing_cells(header, store.records()).empty());
}

TEST_CASE("Blocks take about a minute, as the last one's time tells") {
  const TempFolder folder;
  const SweepHeader header = header_of();
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {1, 100, 60.0});
  auto block = queue.next();
  REQUIRE(block);
  CHECK(block->cells.size() == 1);  // nothing is known yet
  queue.finish(*block, records_of(*block), 20.0);
  block = queue.next();
  CHECK(block->cells.size() == 3);
  queue.finish(*block, records_of(*block), 360.0);
  CHECK(queue.next()->cells.size() == 1);
}

TEST_CASE("Shards share the cells out, and together they are the sweep") {
  const SweepHeader header = header_of();
  std::vector<CellRecord> all;
  for (std::size_t index = 1; index <= 3; ++index) {
    const TempFolder folder;
    SweepStore store(folder.path(), to_json(header));
    SweepQueue queue(store, header, {index, 3}, {2, 100, 60.0});
    work_off(queue);
    CHECK(store.records().size() == 8);
    CHECK(missing_cells(header, all).size() == 24 - all.size());
    all.insert(all.begin(), store.records().begin(), store.records().end());
  }
  const TempFolder folder;
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {1, 1, 60.0});
  work_off(queue);
  CHECK(rates_in(outcome_of(header, all)) == rates_in(outcome_of(header, store.records())));
}

TEST_CASE("A shard is I/N") {
  CHECK(parse_shard("2/3").index == 2);
  CHECK(parse_shard("2/3").count == 3);
  for (const char* const text : {"", "2", "0/3", "4/3", "2/3x", "/3", "2/", "-1/3", "a/b"}) {
    CHECK_THROWS_WITH(parse_shard(text), Contains("I/N"));
  }
}

TEST_CASE("Halving judges few cells on many frames, however often it is interrupted") {
  const SweepHeader header = header_of(SearchOptions::Search::halving);
  const TempFolder folder, other;
  {
    SweepStore store(folder.path(), to_json(header));
    SweepQueue queue(store, header, {}, {1, 100, 60.0});
    work_off(queue);
    std::size_t judged = 0;
    for (const CellRecord& record : store.records()) judged += record.frames.size();
    CHECK(judged <= 2 * 40 * 12 / 2);
    const SweepOutcome outcome = outcome_of(header, store.records());
    CHECK(outcome.best == 7);
    CHECK(outcome.cells[7].total.frames.of == 80);
    CHECK_FALSE(outcome.cells[7].dropped_after_round);
    CHECK(outcome.cells[0].dropped_after_round == 0);
    CHECK(missing_cells(header, store.records()).empty());
  }
  std::string rates;
  for (int interrupted_after = 0;; ++interrupted_after) {
    SweepStore store(other.path(), to_json(header));
    SweepQueue queue(store, header, {}, {1, 100, 60.0});
    const auto block = queue.next();
    if (!block) {
      CHECK(interrupted_after > 3);
      CHECK(missing_cells(header, store.records()).empty());
      rates = rates_in(outcome_of(header, store.records()));
      break;
    }
    queue.finish(*block, records_of(*block), 1.0);
  }
  SweepStore store(folder.path(), to_json(header));
  CHECK(rates == rates_in(outcome_of(header, store.records())));
}

TEST_CASE("The best cell is one of those that were judged on all frames") {
  const SweepHeader header = header_of(SearchOptions::Search::halving);
  std::vector<CellRecord> records = records_of({0, 0, {4, 0}, {5, 7}});
  for (const std::int64_t round : {1, 2}) {
    records.push_back(records_of({0, round, {4 / round, 2 / round}, {5}}).front());
  }
  const SweepOutcome outcome = outcome_of(header, records);  // 7 found all, but was dropped
  CHECK(outcome.best == 5);
  CHECK(outcome.cells[7].dropped_after_round == 0);
}

TEST_CASE("A cell that is missing in any round is missing") {
  const SweepHeader header = header_of(SearchOptions::Search::halving);
  const TempFolder folder;
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {1, 100, 60.0});
  work_off(queue);
  for (const CellRecord& lost : store.records()) {
    std::vector<CellRecord> others;
    for (const CellRecord& record : store.records()) {
      if (&record != &lost) others.push_back(record);
    }
    const auto missing = missing_cells(header, others);
    REQUIRE(missing.size() == 1);
    CHECK(missing.front() == std::pair(lost.cell, lost.recording));
  }
}

TEST_CASE("Threads wait for a round's end, and end together") {
  const TempFolder folder;
  const SweepHeader header = header_of(SearchOptions::Search::halving);
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {3, 2, 60.0});
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back([&] { work_off(queue, 1.0); });
  for (std::thread& thread : threads) thread.join();
  CHECK(queue.is_complete());
  CHECK(outcome_of(header, store.records()).best == 7);
}

TEST_CASE("A queue that was stopped hands nothing out and is not complete") {
  const TempFolder folder;
  const SweepHeader header = header_of();
  SweepStore store(folder.path(), to_json(header));
  SweepQueue queue(store, header, {}, {});
  REQUIRE(queue.next());
  queue.stop();
  CHECK_FALSE(queue.next());
  CHECK_FALSE(queue.is_complete());
}
