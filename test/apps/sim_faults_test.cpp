// What esi-sim refuses, and what it leaves when something goes wrong.
#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>
#include <string>

#include "apps/sim_command.hpp"
#include "support/folder_digest.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("bad simulation configs are told in one line, and nothing is written") {
  struct Row {
    const char* config;
    const char* arguments;
    const char* told;
  };
  const auto row =
      GENERATE(Row{R"({"treshold": 0.2})", "", "did you mean 'threshold'?"},
               Row{R"({"threshold": 9})", "", "0.01 to 5"}, Row{R"({"threshold": "0.2"})", "", "threshold"},
               Row{R"({"seed": 1, "seed": 2})", "", "there twice"}, Row{"{\"seed\": 1,\n}", "", "line 2"},
               Row{R"([])", "", "JSON object"}, Row{R"({"write": "h5,mp4"})", "", "'mp4'"},
               Row{"{}", "--write ''", "option write"}, Row{R"({"trajectory": "fly"})", "", "flight"},
               Row{R"({"sensor": "8x8"})", "", "16 to 4096"}, Row{R"({"crop": "900x900"})", "", "crop"},
               Row{R"({"exposure_ms": 90})", "", "frame_period_ms"},
               Row{R"({"hot_min_hz": 100})", "", "hot_max_hz"}, Row{"{}", "--set x", "key=value"},
               Row{"{}", "--duration nan", "duration_s"}, Row{"{}", "--fsp 3", "there is no option --fsp"},
               Row{"{}", "--threads 0", "--threads"}, Row{R"({"trajectory": "poses"})", "", "option poses"});
  const TempFolder folder;
  const auto config = folder.write("bad.json", row.config);
  const auto result = run_shell(sim() + " --config " + quoted(config) + " " + row.arguments + " -o " +
                                quoted(folder / "out"));
  CAPTURE(row.config, row.arguments, result.err);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err, StartsWith("esi-sim: ") && Contains(row.told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("what cannot be a simulation's folder is refused") {
  const TempFolder folder;
  CHECK_THAT(run_shell(sim() + tiny()).err, Contains("-o"));
  CHECK(simulate(folder / "flight.mp4").exit_code == 2);
  CHECK(run_shell(sim() + tiny() + " -o -").exit_code == 2);
  const auto file = folder.write("file", "");
  CHECK(simulate(file).exit_code == 2);
}

TEST_CASE("an older simulation is replaced only with --force, and nothing else is") {
  const TempFolder folder;
  const auto out = folder / "out";
  REQUIRE(simulate(out, "--write txt --clean-frames --labels --preview").exit_code == 0);
  const auto refused = simulate(out);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Contains("--force") && !Contains("--resume"));
  REQUIRE(simulate(out, "--force").exit_code == 0);
  REQUIRE(simulate(folder / "new").exit_code == 0);
  CHECK((digest_of(out) == digest_of(folder / "new")));

  for (const char* const stranger : {"thesis.tex", "frames/thesis.tex"}) {
    folder.write(std::string("out/") + stranger, "years of work");
    const auto kept = simulate(out, "--force");
    CHECK(kept.exit_code == 2);
    CHECK_THAT(kept.err, Contains(stranger));
    CHECK(fs::exists(out / "run.json"));
    fs::remove(out / stranger);
  }
}

TEST_CASE("INT and TERM stop a simulation, which then is not complete") {
  const auto [signal, code] = GENERATE(std::pair{"INT", 130}, std::pair{"TERM", 143});
  const TempFolder folder;
  const auto out = folder / "out";
  const auto result = run_shell(sim() + " --quiet --duration 1000 --clean-frames -o " + quoted(out) +
                                " & tool=$!; while [ ! -e " + quoted(out / "clean/frame_0000000003.png") +
                                " ]; do sleep 0.02; done; kill -" + signal + " $tool; wait $tool");
  CAPTURE(result.err);
  CHECK(result.exit_code == code);
  CHECK_FALSE(fs::exists(out / "run.json"));
  CHECK_FALSE(fs::exists(out / "events.h5"));
}

TEST_CASE("a disk that fills up leaves no simulation that claims to be complete") {
  const TempFolder folder;
  const auto disk = folder / "disk";
  fs::create_directories(disk);
  const auto on_disk = [&](const std::string& command) {
    const std::string script =
        "mount -t tmpfs -o size=100k tmpfs " + quoted(disk) + " || exit 99\n" + command;
    return run_shell("unshare -rm bash -c " + quoted(script));
  };
  if (on_disk("true").exit_code != 0) {
    std::cerr << "SKIPPED: no disk can be mounted here\n";
    return;
  }
  const std::string format = GENERATE("h5", "aedat4", "txt");
  const auto result =
      on_disk(sim() + tiny() + " --shot-hz 200 --write " + format + " -o " + quoted(disk / "out") +
              "\ncode=$?\n[ ! -e " + quoted(disk / "out/run.json") + " ] || exit 98\n[ ! -e " +
              quoted(disk / ("out/events." + format)) + " ] || exit 97\nexit $code");
  CAPTURE(format, result.err);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, StartsWith("esi-sim: ") && Contains("No space left"));
}
