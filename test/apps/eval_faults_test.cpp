// What esi-eval refuses, and what it leaves when something goes wrong.
#include <algorithm>
#include <catch2/catch.hpp>

#include "apps/eval_command.hpp"
#include "support/folder_digest.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string start() { return quoted(flight_start()); }

}  // namespace

TEST_CASE("wrong usage is told in one line, and nothing is written") {
  const TempFolder folder;
  folder.write("events.txt", "0.0 1 1 1\n");
  folder.write("size.json", R"({"method": "esi", "size": "9x9"})");
  fs::create_directories(folder / "empty");
  struct Case {
    std::string arguments, told;
  };
  const std::string out = " -o out";
  const auto [arguments, told] =
      GENERATE_COPY(Case{start() + " --method esi", "say with -o"}, Case{start() + out, "say with --method"},
                    Case{"--method esi" + out, "give a recording"},
                    Case{start() + " --method esi -o report.mp4", "give a folder"},
                    Case{start() + " --method esi -o -", "give a folder"},
                    Case{"events.txt --method esi" + out, "say with -g"},
                    Case{"--frames empty" + out, "there is no empty/ground_truth.json"},
                    Case{"- --method esi -g x.json" + out, "standard input"},
                    Case{start() + " -g x.json -g y.json --method esi" + out, "2 ground truths for 1 inputs"},
                    Case{start() + " " + start() + " --method esi" + out, "given twice"},
                    Case{start() + " --method esi --method esi" + out, "given twice"},
                    Case{start() + " --method eis" + out, "did you mean"},
                    Case{start() + " --method size.json" + out, "all methods share"},
                    Case{start() + " --method esi --require landing'>'=0.5" + out, "no such phase or method"},
                    Case{start() + " --method esi --require total=1" + out, "such as total>=0.8"},
                    Case{start() + " --method esi --family tag36h10" + out, "use --family tag36h11"},
                    Case{start() + " --method esi --family tag36" + out, "tag36h11"},
                    Case{start() + " --method esi --ids 600 " + out, "0 to 586"},
                    Case{start() + " --method esi --roi 0,0,64x64 " + out, "leave out --roi"},
                    Case{start() + " --method esi --threads 0" + out, "--threads"},
                    Case{start() + " --method esi --stirde 2" + out, "did you mean --stride"},
                    Case{start() + " --method esi --stride nan" + out, "stride"});
  const auto result = run_shell("cd " + quoted(folder.path()) + " && " + eval() + " " + arguments);
  CAPTURE(arguments, result.err);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err, StartsWith("esi-eval: ") && Contains(told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK(result.out.empty());
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a folder that is not empty is refused before the work, and only a report is replaced") {
  const TempFolder folder;
  const auto out = folder / "out";
  const std::string arguments = start() + " --method esi";
  REQUIRE(evaluate(out, arguments).exit_code == 0);
  const std::string absent =
      "absent.aedat4 --method esi -g " + quoted(flight().parent_path() / "ground_truth.json");
  const auto refused = evaluate(out, absent);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Contains("--force") && !Contains("--resume"));
  // An older report survives a run that fails.
  CHECK(evaluate(out, absent + " --force").exit_code == 1);
  CHECK(fs::exists(out / "run.json"));
  CHECK(evaluate(out, arguments + " --no-tracking --force").exit_code == 0);
  CHECK_FALSE(fs::exists(out / "truth_0.tum"));
  folder.write("out/thesis.tex", "years of work");
  CHECK_THAT(evaluate(out, arguments + " --force").err, Contains("thesis.tex"));
  CHECK(content_of(out / "thesis.tex") == "years of work");
  const auto file = folder.write("file", "");
  CHECK(evaluate(file, arguments).exit_code == 2);
  CHECK_THAT(evaluate(file / "deeper", arguments).err, Contains("is a file"));
}

TEST_CASE("a requirement that is missed exits with 4, with the report; one that is met with 0") {
  const TempFolder folder;
  const std::string arguments = quoted(flight()) + " --start 1 --end 1.2 --method esi --require ";
  const auto met = evaluate(folder / "met", arguments + "'esi:total>=0.1'");
  CHECK(met.exit_code == 0);
  CHECK(met.err.empty());
  const auto missed = evaluate(folder / "missed", arguments + "'total>=0.1' --require 'straight>=1'");
  CHECK(missed.exit_code == 4);
  CHECK_THAT(missed.err, StartsWith("esi-eval: straight>=1 is missed by esi on "));
  CHECK(std::count(missed.err.begin(), missed.err.end(), '\n') == 1);
  CHECK(fs::exists(folder / "missed" / "run.json"));
}

TEST_CASE("a damaged recording is evaluated as far as it goes, and the losses are told with exit code 3") {
  const TempFolder folder;
  const std::string text = content_of(source_dir() / "data-samples/flight-start/events.txt");
  const auto cut = folder.write("events.txt", text.substr(0, text.size() - 5));
  const std::string arguments =
      quoted(cut) + " --method esi -g " + quoted(flight_start().parent_path() / "ground_truth.json");
  const auto result = evaluate(folder / "out", arguments);
  CHECK(result.exit_code == 3);
  CHECK_THAT(result.err, Contains("part of the input was left out: ") && Contains("events.txt: 1 cut_line"));
  CHECK(report_of(folder / "out")["inputs"][0]["lost"] == "1 cut_line");
  CHECK(evaluate(folder / "strict", arguments + " --strict").exit_code == 1);
  CHECK_FALSE(fs::exists(folder / "strict"));
  // A requirement that is missed says more.
  CHECK(evaluate(folder / "missed", arguments + " --require 'total>=1'").exit_code == 4);
}

TEST_CASE("INT and TERM leave nothing that claims to be complete") {
  const auto [signal, code] = GENERATE(std::pair{"INT", 130}, std::pair{"TERM", 143});
  const TempFolder folder;
  const auto out = folder / "out";
  // 20 000 frames a second take a minute or so. Before the tool catches INT and TERM, the shell's background
  // jobs ignore INT.
  const auto result =
      run_shell(eval() + " --quiet " + quoted(flight()) + " --fps 20000 --method esi -o " + quoted(out) +
                " & tool=$!; while kill -0 $tool && ! grep -qs 'SigCgt:.*[4-7c-f]..[2367abef]$' " +
                "/proc/$tool/status; do sleep 0.02; done; sleep 0.3; kill -" + signal + " $tool; wait $tool");
  CAPTURE(result.err);
  CHECK(result.exit_code == code);
  CHECK_FALSE(fs::exists(out / "run.json"));
  CHECK_FALSE(fs::exists(out / "report.json"));
}

TEST_CASE("frames that are not as they should be are told with their file") {
  const TempFolder folder;
  const std::string truth =
      folder.write("ground_truth.json", R"({"phases": [{"name": "a", "start_s": 0, "end_s": 1}]})");
  const auto made = run_tool("esi-recon", {flight_start(), "--quiet", "-o", folder / "frames"});
  REQUIRE(made.exit_code == 0);
  const std::string arguments = "--frames " + quoted(folder / "frames") + " -g " + quoted(truth);
  const auto told = [&](const std::string& more = {}) {
    const auto result = evaluate(folder / "out", arguments + more);
    CHECK(result.exit_code != 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK_FALSE(fs::exists(folder / "out"));
    return result.err;
  };
  CHECK_THAT(told(" --roi 0,0,64x64"), Contains("frames are judged whole"));
  CHECK_THAT(told(" --start 7"), Contains("no frames in the part"));
  folder.write("frames/frame_0000000003.png", "no picture");
  CHECK_THAT(told(), Contains("frame_0000000003.png: is not a picture"));
  fs::copy_file(source_dir() / "docs/pictures/tagboard.png", folder / "frames/frame_0000000003.png",
                fs::copy_options::overwrite_existing);
  CHECK_THAT(told(), Contains("frame_0000000003.png: it is 1054x260 px large"));
  fs::remove(folder / "frames" / "frame_0000000003.png");
  CHECK_THAT(told(), Contains("frame_0000000003.png"));
  fs::remove(folder / "frames" / "images.txt");
  CHECK_THAT(told(), Contains("timestamps.txt: has 20 times for 19 PNG files"));
  fs::remove(folder / "frames" / "timestamps.txt");
  CHECK_THAT(told(), Contains("neither images.txt nor timestamps.txt"));
}
