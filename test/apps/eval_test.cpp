// What the real esi-eval writes, against counts of its own.
#include <catch2/catch.hpp>

#include "apps/eval_count.hpp"
#include "apps/report_page.hpp"
#include "support/folder_digest.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

std::int64_t number(const json& value) { return value.get<std::int64_t>(); }

/// Time ascends, and each line has the eight numbers of a TUM track, with a quaternion of length 1.
void check_track(const fs::path& file) {
  std::istringstream lines(content_of(file));
  double before_s = -1e9;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::istringstream fields(line);
    std::vector<double> v;
    for (double x = 0; fields >> x;) v.push_back(x);
    REQUIRE(v.size() == 8);
    CHECK(v[0] > before_s);
    before_s = v[0];
    CHECK(v[4] * v[4] + v[5] * v[5] + v[6] * v[6] + v[7] * v[7] == Approx(1.0));
  }
  CHECK(count > 10);
}

const std::vector<std::string> kFiles = {
    "cost.csv", "detections.csv", "frames.csv", "report.html",   "report.json",   "run.json",   "table.csv",
    "table.md", "table.tex",      "tags.csv",   "track_0_0.tum", "track_0_1.tum", "truth_0.tum"};

}  // namespace

TEST_CASE("a report has every file, and its numbers are those of a count over detections and truth") {
  const TempFolder folder;
  const auto out = folder / "out";
  const auto result =
      run_shell(eval() + " " + quoted(flight()) + " --method esi --method accumulator -o " + quoted(out));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK(names_in(out) == kFiles);
  CHECK(result.out == content_of(out / "table.md").substr(0, result.out.size()));

  const CountsByPhase counts = counted(out, flight().parent_path());
  CHECK(counts.size() == 6);
  Counts of_esi;
  for (const auto& [key, count] : counts) {
    if (key[1] == "esi") of_esi = {of_esi.frames + count.frames, of_esi.detected + count.detected, 0};
  }
  CHECK(of_esi.frames == 299);
  CHECK(of_esi.detected > 200);
  const auto table = csv_rows(out / "table.csv");
  CHECK(table.size() == 8);
  for (const Row& row : table) {
    if (row.at("phase") == "total") continue;
    CAPTURE(row.at("method"), row.at("phase"));
    const Counts& count = counts.at({row.at("input"), row.at("method"), row.at("phase")});
    CHECK(row.at("frames") == std::to_string(count.frames));
    CHECK(row.at("detected") == std::to_string(count.detected));
    const int wrong = std::stoi(row.at("false_foreign")) + std::stoi(row.at("false_misplaced")) +
                      std::stoi(row.at("false_duplicate"));
    CHECK(wrong == count.wrong);
  }
  const json report = report_of(out);
  const json& methods = report["results"][0]["methods"];
  REQUIRE(methods.size() == 2);
  for (const json& method : methods) {
    for (const json& phase : method["phases"]) {
      const Counts& count = counts.at({flight().string(), method["method"], phase["name"]});
      CHECK(number(phase["frames"]["hits"]) == count.detected);
      CHECK(number(phase["frames"]["of"]) == count.frames);
    }
    CHECK(method["tracking"]["total"]["available"]["of"] == 299);
  }
  const std::string total = std::to_string(of_esi.detected) + "/299";
  CHECK_THAT(content_of(out / "table.md"), Contains("| esi | ") && Contains(total));
  CHECK_THAT(content_of(out / "table.tex"), Contains("esi & ") && Contains(total) && Contains("\\toprule"));
  CHECK_THAT(content_of(out / "report.html"), Contains(total));
  CHECK(report["inputs"][0]["events"]["count"] == 1178920);
  CHECK(report["config"]["family"] == "tag36h11");
  check_page(out / "report.html");
  CHECK_THAT(content_of(out / "report.html"), Contains("<img src=\"data:image/png"));
  for (const char* const track : {"track_0_0.tum", "track_0_1.tum", "truth_0.tum"}) check_track(out / track);
  for (const Row& row : csv_rows(out / "cost.csv")) {
    CHECK(row.at("frames") == "300");
    CHECK(std::stod(row.at("mev_s")) > 0.1);
    CHECK(std::stod(row.at("detection_ms_mean")) > 0.0);
  }
}

TEST_CASE("any number of threads gives the same bytes but for what tells of the run") {
  const TempFolder folder;
  const std::string arguments = quoted(flight()) + " --end 1 --method esi --method complementary --threads ";
  REQUIRE(evaluate(folder / "one", arguments + "1").exit_code == 0);
  REQUIRE(evaluate(folder / "two", arguments + "2").exit_code == 0);
  CHECK(names_in(folder / "one") == names_in(folder / "two"));
  for (const std::string& name : names_in(folder / "one")) {
    if (name == "cost.csv" || name == "report.html" || name.ends_with(".json")) continue;
    CAPTURE(name);
    CHECK((content_of(folder / "one" / name) == content_of(folder / "two" / name)));
  }
  json one = report_of(folder / "one"), two = report_of(folder / "two");
  CHECK(one["run"]["threads"] == 1);
  CHECK(two["run"]["threads"] == 2);
  one.erase("run");
  two.erase("run");
  CHECK(one == two);
}

TEST_CASE("a folder of frames that esi-recon made scores as the recording itself") {
  const TempFolder folder;
  const std::string part = " --end 1.2";
  const auto made = run_tool(
      "esi-recon", {flight(), "--size", "128x96", "--end", "1.2", "--quiet", "-o", folder / "frames"});
  REQUIRE(made.exit_code == 0);
  const std::string truth = " -g " + quoted(flight().parent_path() / "ground_truth.json");
  REQUIRE(evaluate(folder / "a", quoted(flight()) + truth + part + " --method esi").exit_code == 0);
  REQUIRE(evaluate(folder / "b", "--frames " + quoted(folder / "frames") + truth).exit_code == 0);
  json a = report_of(folder / "a")["results"][0]["methods"][0];
  json b = report_of(folder / "b")["results"][0]["methods"][0];
  CHECK(b["method"] == "frames");
  a.erase("method");
  b.erase("method");
  CHECK(a == b);
  CHECK(number(a["total"]["frames"]["hits"]) > 20);
  const Row cost = csv_rows(folder / "b" / "cost.csv").at(0);
  CHECK(cost.at("reconstruction_ms_mean").empty());
  CHECK(std::stod(cost.at("detection_ms_mean")) > 0.0);

  // A part of them, half-open.
  REQUIRE(
      evaluate(folder / "part", "--frames " + quoted(folder / "frames") + truth + " --start 0.5 --end 0.6")
          .exit_code == 0);
  const auto rows = csv_rows(folder / "part" / "frames.csv");
  REQUIRE(rows.size() == 10);
  CHECK(rows.front().at("t_us") == "500000");
  CHECK(rows.back().at("t_us") == "590000");
}

TEST_CASE("on a terminal one line tells how far it is, and none of it is left") {
  const TempFolder folder;
  const auto on_terminal = [&](const std::string& arguments) {
    const std::string command =
        "stty cols 50; " + eval() + " " + arguments + " -o " + quoted(folder / "out") + " --force";
    return run_shell("TERM=xterm script -qec " + quoted(command) + " /dev/null").out;
  };
  const auto shown = [](const std::string& out) {  // what stands between two rewritings
    std::vector<std::string> lines;
    const std::string rewrite = "\r\x1b[K";
    for (auto at = out.find(rewrite); at != std::string::npos;) {
      const auto begin = at + rewrite.size();
      at = out.find(rewrite, begin);
      if (at != std::string::npos) lines.push_back(out.substr(begin, at - begin));
    }
    return lines;
  };
  const auto of_recording = shown(on_terminal(quoted(flight()) + " --method esi"));
  REQUIRE_FALSE(of_recording.empty());
  for (const std::string& line : of_recording) {
    CHECK(line.size() < 50);
    CHECK_THAT(line, StartsWith("[") && Contains("] ") && Contains(" Mev"));
  }
  REQUIRE(run_shell(quoted(tool("esi-recon")) + " " + quoted(flight()) + " --size 128x96 --quiet -o " +
                    quoted(folder / "frames"))
              .exit_code == 0);
  const auto of_frames = shown(on_terminal("--frames " + quoted(folder / "frames") + " -g " +
                                           quoted(flight().parent_path() / "ground_truth.json")));
  REQUIRE_FALSE(of_frames.empty());
  CHECK_THAT(of_frames.back(), Contains(" frames") && !Contains("Mev"));
}
