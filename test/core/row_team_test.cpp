#include "esi/core/row_team.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

using namespace esi;

namespace {

std::shared_ptr<WorkerPool> workers(int count) { return std::make_shared<WorkerPool>(count); }

/// How often each of `count` calls was made. Not atomic: the team must order the accesses.
std::vector<int> calls_of(const RowTeam& team, int count) {
  std::vector<int> calls(static_cast<std::size_t>(count), 0);
  team.each(count, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
  return calls;
}

/// Two calls that both wait for the other to have begun, for as long as 10 s.
bool two_work_at_once(const RowTeam& team) {
  std::atomic<int> begun = 0;
  std::atomic<int> met = 0;
  team.each(2, [&](int) {
    ++begun;
    for (int i = 0; i < 1000 && begun < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    met += begun == 2 ? 1 : 0;
  });
  return met == 2;
}

}  // namespace

TEST_CASE("Every call is made once, for any number of workers, within a shift and outside") {
  const int count = GENERATE(0, 1, 3, 7);
  RowTeam team;
  team.use(workers(count));
  for (int shift = 0; shift < 3; ++shift) {
    const auto first = team.begin_shift();
    for (int i = 0; i < 200; ++i) CHECK(calls_of(team, i % 40) == std::vector<int>(i % 40, 1));
    { const auto inner = team.begin_shift(); }
    CHECK(calls_of(team, 20) == std::vector<int>(20, 1));
  }
  CHECK(calls_of(team, 20) == std::vector<int>(20, 1));
  CHECK(calls_of(kAlone, 20) == std::vector<int>(20, 1));
}

TEST_CASE("A worker that has nothing else to do takes part, also after an inner shift") {
  RowTeam team;
  team.use(workers(1));
  const auto shift = team.begin_shift();
  CHECK(two_work_at_once(team));
  { const auto inner = team.begin_shift(); }
  CHECK(two_work_at_once(team));
}

TEST_CASE("Nobody waits for workers that are busy, and those that come too late find nothing") {
  const auto pool = workers(1);
  std::promise<void> begun, release;
  auto busy = pool->submit([&] {
    begun.set_value();
    release.get_future().wait();
  });
  begun.get_future().wait();
  RowTeam team;
  team.use(pool);
  for (int i = 0; i < 3; ++i) {
    const auto shift = team.begin_shift();
    CHECK(calls_of(team, 20) == std::vector<int>(20, 1));
  }
  release.set_value();
  pool->finish(std::move(busy));
  pool->submit([] {}).get();  // behind what the shifts left
}

TEST_CASE("An error comes back once all calls have ended, and the team lives on") {
  RowTeam team;
  team.use(workers(3));
  const auto shift = team.begin_shift();
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> running = 0;
    const auto work = [&](int i) {
      ++running;
      std::this_thread::yield();
      --running;
      if (i == 5) throw std::runtime_error("row " + std::to_string(i));
    };
    CHECK_THROWS_WITH(team.each(20, work), "row 5");
    CHECK(running == 0);
  }
  CHECK(calls_of(team, 20) == std::vector<int>(20, 1));
}

TEST_CASE("Rows are cut at multiples of the step, into pieces that are worth it") {
  RowTeam team;
  team.use(workers(2));
  CHECK(team.cuts(720, 1280, 8) == std::vector<int>{0, 720});  // no shift, nobody there
  const auto shift = team.begin_shift();
  CHECK(team.cuts(720, 1280, 1) == std::vector<int>{0, 120, 240, 360, 480, 600, 720});
  CHECK(team.cuts(721, 1280, 50) == std::vector<int>{0, 100, 200, 350, 450, 600, 721});
  CHECK(team.cuts(100, 20000, 30) == std::vector<int>{0, 30, 60, 100});
  CHECK(team.cuts(32, 128, 1) == std::vector<int>{0, 16, 32});
  CHECK(team.cuts(31, 128, 1) == std::vector<int>{0, 31});
  CHECK(team.cuts(1, 65535, 1) == std::vector<int>{0, 1});
  CHECK(team.cuts(65535, 65535, 1).size() == 7);
  std::vector<int> seen(97, 0);
  team.over_rows({300, 97}, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) ++seen[static_cast<std::size_t>(y)];
  });
  CHECK(seen == std::vector<int>(97, 1));
}
