// What esi-sweep refuses, and what it leaves when something goes wrong.
#include <catch2/catch.hpp>
#include <iostream>

#include "apps/sweep_command.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("sweeps that can't be are refused in one line before anything is written") {
  const TempFolder folder;
  struct Case {
    std::string arguments, told;
  };
  const auto [arguments, told] = GENERATE(
      Case{"--grid tau_s=0.1:1000:0.1 --grid c_on=0.1:10:0.1 --grid c_off=0.1:10:0.1 --grid clamp=0.1:10:0.1 "
           "--grid n=1:8:0.07",
           "has 1.01e+12 cells"},
      Case{"--grid n=log:0:8:4", "not above 0"}, Case{"--grid tua_s=1,2", "tua_s"},
      Case{"--grid tau_s=1,-4", "-4"}, Case{"--shard 4/3", "--shard"}, Case{"--shard 0/3", "--shard"},
      Case{"--shard 1/2 --search halving", "halving"}, Case{"--threads 0", "--threads"});
  const auto result = sweep(folder / "out", small_sweep() + arguments);
  CAPTURE(arguments, result.err);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err, StartsWith("esi-sweep: ") && Contains(told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a second sweep on a folder in use is refused, one with other parameters too") {
  const TempFolder folder;
  REQUIRE(sweep(folder / "out", small_sweep()).exit_code == 0);
  const auto store = folder / "out" / "cells.jsonl";
  const auto second = run_shell("(flock 9; " + quoted(tool("esi-sweep")) + " -o " + quoted(folder / "out") +
                                " " + small_sweep() + ") 9>>" + quoted(store));
  CHECK(second.exit_code == 1);
  CHECK_THAT(second.err, Contains("another run is writing it"));
  const std::string before = content_of(store);
  const auto other = sweep(folder / "out", small_sweep() + "--grid clamp=1,2,4");
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Contains("another sweep") && Contains("grid"));
  CHECK(content_of(store) == before);
}

TEST_CASE("a torn last line is made again, a torn inner line is an error with its number") {
  const TempFolder folder;
  REQUIRE(sweep(folder / "out", small_sweep()).exit_code == 0);
  const std::string wanted = digest_of_sweep(folder / "out");
  const std::string text = content_of(folder / "out" / "cells.jsonl");
  folder.write("out/cells.jsonl", text.substr(0, text.size() - 40));
  REQUIRE(sweep(folder / "out", small_sweep()).exit_code == 0);
  CHECK(digest_of_sweep(folder / "out") == wanted);
  const std::size_t second = text.find('\n') + 1;
  folder.write("out/cells.jsonl", text.substr(0, second + 30) + text.substr(text.find('\n', second)));
  const auto torn = sweep(folder / "out", small_sweep());
  CHECK(torn.exit_code == 1);
  CHECK_THAT(torn.err, Contains("cells.jsonl, line 2: "));
}

TEST_CASE("a sweep whose files may not grow fails with the reason and goes on when they may") {
  const TempFolder folder;
  REQUIRE(sweep(folder / "whole", small_sweep()).exit_code == 0);
  const auto limited = run_shell("ulimit -f 3; " + quoted(tool("esi-sweep")) + " -o " +
                                 quoted(folder / "out") + " " + small_sweep());
  CAPTURE(limited.err);
  CHECK(limited.exit_code == 1);
  CHECK_THAT(limited.err, StartsWith("esi-sweep: ") && Contains("File too large"));
  CHECK_FALSE(fs::exists(folder / "out" / "run.json"));
  REQUIRE(sweep(folder / "out", small_sweep()).exit_code == 0);
  CHECK(digest_of_sweep(folder / "out") == digest_of_sweep(folder / "whole"));
}

TEST_CASE("a full disk and a read-only one are failures with their reason") {
  const TempFolder folder;
  const auto [options, reason] =
      GENERATE(std::pair{"size=8k", "No space left"}, std::pair{"size=64k,ro", "Read-only"});
  fs::create_directories(folder / "disk");
  const std::string disk = quoted(folder / "disk");
  const auto result =
      run_shell("unshare -rm bash -c " + quoted("mount -t tmpfs -o " + std::string(options) + " tmpfs " +
                                                disk + " || exit 99\n" + quoted(tool("esi-sweep")) + " -o " +
                                                quoted(folder / "disk" / "out") + " " + small_sweep()));
  if (result.exit_code == 99 || result.err.find("unshare") != std::string::npos) {
    std::cerr << "SKIPPED: no disk can be mounted here\n";
    return;
  }
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, StartsWith("esi-sweep: ") && Contains(reason));
}

TEST_CASE("INT and TERM keep what is done") {
  const auto [signal, code] = GENERATE(std::pair{"INT", 130}, std::pair{"TERM", 143});
  const TempFolder folder;
  const std::string flight = quoted(source_dir() / "data-samples/flight/events.h5");
  const auto result =
      run_shell(quoted(tool("esi-sweep")) + " " + flight + " --grid clamp=1:4:0.05 --quiet -o " +
                quoted(folder / "out") + " & tool=$!; until [ -s " + quoted(folder / "out" / "cells.jsonl") +
                " ]; do sleep 0.05; done; kill -" + signal + " $tool; wait $tool");
  CAPTURE(result.err);
  CHECK(result.exit_code == code);
  CHECK_FALSE(fs::exists(folder / "out" / "run.json"));
}
