// Leader and others of a team, in one process: what they ask and answer.
#include <catch2/catch.hpp>
#include <thread>

#include "esi/core/error.hpp"
#include "esi/sweep/remote_work.hpp"
#include "esi/sweep/sweep_desk.hpp"
#include "support/temp_folder.hpp"
#include "sweep/made_work.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

class TeamOfThreads final : public SweepTeam {
 public:
  explicit TeamOfThreads(SweepDesk& desk) : desk_(desk) {}

  bool is_leader() const override { return false; }
  int processes() const override { return 3; }
  bool begin() override { return true; }
  void serve(const Answer& /*answer*/, const std::function<void()>& /*tick*/) override {}
  std::string ask(const std::string& question) override {
    const std::lock_guard lock(mutex_);
    return desk_.answer(question);
  }

 private:
  SweepDesk& desk_;
  std::mutex mutex_;
};

struct Leader {
  explicit Leader(SweepHeader own, SweepShard shard = {})
      : header(std::move(own)),
        store(folder.path(), to_json(header)),
        queue(store, header, shard, {3, 2, 60.0}) {}

  TempFolder folder;
  SweepHeader header;
  SweepStore store;
  SweepQueue queue;
  SweepDesk desk{queue, header};
  TeamOfThreads team{desk};
};

}  // namespace

TEST_CASE("Others and the leader together find what one alone does, in every round") {
  const auto search = GENERATE(SearchOptions::Search::full, SearchOptions::Search::halving);
  Leader alone(header_of(search));
  work_off(alone.queue);
  Leader leader(header_of(search));
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      RemoteWork work(leader.team, leader.header);
      while (const auto block = work.next()) work.finish(*block, records_of(*block), 1.0);
    });
  }
  work_off(leader.queue, 1.0);
  for (std::thread& thread : threads) thread.join();
  leader.desk.rethrow();
  CHECK(leader.queue.is_complete());
  CHECK(leader.store.records().size() == alone.store.records().size());
  CHECK(rates_in(outcome_of(leader.header, leader.store.records())) ==
        rates_in(outcome_of(alone.header, alone.store.records())));
}

TEST_CASE("Who has another recording is told so, and the sweep ends for all") {
  Leader leader(header_of());
  SweepHeader other = header_of();
  other.recordings[1].crc32 = "ffffffff";
  CHECK_THROWS_WITH(RemoteWork(leader.team, other), Contains("ffffffff") && Contains("same files"));
  CHECK(leader.queue.is_stopped());
}

TEST_CASE("One who stops, stops all; the leader's stop reaches the others") {
  Leader first(header_of());
  RemoteWork work(first.team, first.header);
  REQUIRE(work.next());
  work.stop();
  CHECK(first.queue.is_stopped());
  CHECK_FALSE(work.next());

  Leader second(header_of());
  RemoteWork other(second.team, second.header);
  CHECK_FALSE(other.wait_for_end(std::chrono::milliseconds(1)));
  second.queue.stop();
  CHECK_FALSE(other.next());
  CHECK(other.has_ended());
}

TEST_CASE("What no question is ends the sweep with an error") {
  for (const char* const question : {"", "{}", R"({"ask": "finish"})",
                                     R"({"ask": "finish", "block": {"recording": 9, "round": 0, "stride": 1,
         "first": 0, "cells": [1]}, "seconds": 1, "records": [{}]})"}) {
    Leader leader(header_of());
    CHECK(nlohmann::json::parse(leader.desk.answer(question))["end"] == true);
    CHECK(leader.queue.is_stopped());
    CHECK_THROWS(leader.desk.rethrow());
  }
}

TEST_CASE("Who can't wait is told whether there will be more") {
  Leader leader(header_of(SearchOptions::Search::halving));
  std::vector<SweepBlock> blocks;
  while (const auto block = leader.queue.try_next().block) blocks.push_back(*block);
  CHECK_FALSE(leader.queue.try_next().has_ended);  // the next round waits for these
  for (const SweepBlock& block : blocks) leader.queue.finish(block, records_of(block), 1.0);
  const SweepTurn turn = leader.queue.try_next();
  REQUIRE(turn.block);
  CHECK(turn.block->round == 1);
  leader.queue.stop();
  CHECK(leader.queue.try_next().has_ended);
}
