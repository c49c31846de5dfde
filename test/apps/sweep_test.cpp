// esi-sweep: the same bytes however the work was spread, and whatever ended it in between.
#include <catch2/catch.hpp>
#include <chrono>
#include <random>

#include "apps/sweep_command.hpp"

using namespace esi::test;
using Catch::Matchers::Contains;

TEST_CASE("one thread, two and three merged shards give the same bytes") {
  const TempFolder folder;
  REQUIRE(sweep(folder / "one", small_sweep() + "--threads 1").exit_code == 0);
  const std::string wanted = digest_of_sweep(folder / "one");
  REQUIRE(sweep(folder / "two", small_sweep() + "--threads 2").exit_code == 0);
  CHECK(digest_of_sweep(folder / "two") == wanted);
  std::string shards;
  for (const std::string shard : {"1", "2", "3"}) {
    REQUIRE(sweep(folder / shard, small_sweep() + "--shard " + shard + "/3").exit_code == 0);
    CHECK(lines_of(folder / shard / "cells.jsonl").size() == 3);
    shards += quoted(folder / shard) + " ";
  }
  const auto merged =
      run_shell(quoted(tool("esi-sweep")) + " merge " + shards + "-o " + quoted(folder / "merged"));
  CAPTURE(merged.err);
  CHECK(merged.exit_code == 0);
  CHECK(digest_of_sweep(folder / "merged") == wanted);
}

TEST_CASE("killed twenty times at random moments, a sweep goes on and gives the same bytes") {
  const TempFolder folder;
  const std::string arguments = small_sweep() + "--threads 2";
  const auto began = std::chrono::steady_clock::now();
  REQUIRE(sweep(folder / "whole", arguments).exit_code == 0);
  // Moments of the run's own length: this machine may be slow or busy.
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> seconds(0.1 * whole_s, 0.8 * whole_s);
  int killed = 0, killed_midway = 0;
  for (int i = 0; i < 20; ++i) {
    const auto result =
        run_shell("timeout -s KILL " + std::to_string(seconds(random)) + " " + quoted(tool("esi-sweep")) +
                  " -o " + quoted(folder / "out") + " " + arguments);
    if (result.exit_code != 137) {
      REQUIRE(result.exit_code == 0);
      CHECK(digest_of_sweep(folder / "out") == digest_of_sweep(folder / "whole"));
      std::filesystem::remove_all(folder / "out");
    } else {
      ++killed;
      const auto store = folder / "out" / "cells.jsonl";
      if (std::filesystem::exists(store) && lines_of(store).size() > 1) ++killed_midway;
    }
  }
  CHECK(killed > 0);
  CHECK(killed_midway > 0);
  REQUIRE(sweep(folder / "out", arguments).exit_code == 0);
  CHECK(digest_of_sweep(folder / "out") == digest_of_sweep(folder / "whole"));
}

TEST_CASE("merge says what is missing and the command that makes it, which does") {
  const TempFolder folder;
  const std::string first = quoted(folder / "a shard");
  REQUIRE(sweep(folder / "whole", small_sweep()).exit_code == 0);
  REQUIRE(sweep(folder / "a shard", small_sweep() + "--shard 1/2").exit_code == 0);
  const std::string tool_folder = "PATH=" + quoted(tool("esi-sweep").parent_path()) + ":$PATH; ";
  const std::string out = " -o " + quoted(folder / "merged");
  // The folder of a shard that never began is no error of its own.
  const auto refused = run_shell(tool_folder + "esi-sweep merge " + first + " " + quoted(folder / "b") + out);
  CHECK(refused.exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "merged"));
  CHECK_THAT(refused.err, Contains("3 cells are missing: 1 (tau_s=0.5 clamp=2.0) on "));
  const std::string mark = "make them with: ";
  REQUIRE_THAT(refused.err, Contains(mark));
  const std::string command = refused.err.substr(refused.err.find(mark) + mark.size());
  REQUIRE(run_shell(tool_folder + command).exit_code == 0);
  const std::string second = quoted(folder / "shard-2-of-2");
  // The shard that was made by the command comes first: its header has other spellings of the paths.
  REQUIRE(run_shell(tool_folder + "esi-sweep merge " + second + " " + first + out).exit_code == 0);
  CHECK(digest_of_sweep(folder / "merged") == digest_of_sweep(folder / "whole"));
  CHECK_THAT(run_shell(tool_folder + "esi-sweep merge " + first + " -o " + first).err,
             Contains("one of the shards"));
}
