// What esi-eval makes of different recordings, truths and configs.
#include <catch2/catch.hpp>

#include "apps/eval_count.hpp"
#include "apps/report_page.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("intervals alone are enough of a truth: every id of the family counts") {
  const TempFolder folder;
  const auto truth =
      folder.write("truth.json", R"({"phases": [{"name": "a", "start_s": 1.0, "end_s": 1.3}]})");
  const auto result = evaluate(
      folder / "out", quoted(flight()) + " --size 128x96 --end 1.5 --method esi -g " + quoted(truth));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const Row row = csv_rows(folder / "out" / "table.csv").at(0);
  CHECK(row.at("frames") == "30");
  CHECK(row.at("corner_error_mean_px").empty());
  std::set<std::string> frames;
  for (const Row& tag : csv_rows(folder / "out" / "detections.csv")) {
    const int t_us = std::stoi(tag.at("t_us"));
    if (1'000'000 <= t_us && t_us < 1'300'000) frames.insert(tag.at("frame"));
  }
  CHECK(row.at("detected") == std::to_string(frames.size()));
  CHECK(frames.size() > 5);

  // Ids that are given are expected, all else is false.
  REQUIRE(evaluate(folder / "other",
                   quoted(flight()) + " --size 128x96 --end 1.5 --ids 5 --method esi -g " + quoted(truth))
              .exit_code == 0);
  const Row other = csv_rows(folder / "other" / "table.csv").at(0);
  CHECK(other.at("detected") == "0");
  CHECK(std::stoi(other.at("false_foreign")) >= static_cast<int>(frames.size()));
}

TEST_CASE("several recordings are scored each and together") {
  const TempFolder folder;
  const auto result = run_shell(eval() + " " + quoted(flight()) + " " + quoted(flight_start()) +
                                " --end 0.4 --method esi --method accumulator -o " + quoted(folder / "out"));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("all") && !Contains("events.h5"));
  std::map<std::string, std::array<int, 3>> totals;  // frames by input, of esi
  for (const Row& row : csv_rows(folder / "out" / "table.csv")) {
    if (row.at("phase") != "straight" || row.at("method") != "esi") continue;
    totals[row.at("input")] = {std::stoi(row.at("frames")), std::stoi(row.at("detected")),
                               std::stoi(row.at("tags_found"))};
  }
  REQUIRE(totals.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(totals["all"][i] == totals[flight().string()][i] + totals[flight_start().string()][i]);
  }
  CHECK(totals[flight_start().string()][0] == 19);  // the frame at 0.2 s is in no phase
  const json report = report_of(folder / "out");
  CHECK(report["inputs"].size() == 2);
  CHECK(report["results"].size() == 3);
  CHECK(fs::exists(folder / "out" / "track_1_1.tum"));
  CHECK(fs::exists(folder / "out" / "truth_1.tum"));
  check_page(folder / "out" / "report.html");
}

TEST_CASE("a method with frames of its own times has a base of its own") {
  const TempFolder folder;
  const auto edi = source_dir() / "configs/recon/edi.json";
  const auto result =
      evaluate(folder / "out", quoted(flight_start()) + " --method esi --method " + quoted(edi));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  std::map<std::string, int> frames;
  for (const Row& row : csv_rows(folder / "out" / "cost.csv")) {
    frames[row.at("method")] = std::stoi(row.at("frames"));
  }
  CHECK(frames == std::map<std::string, int>{{"esi", 20}, {"edi", 2}});
}

TEST_CASE("names of phases and methods mean themselves in every file") {
  const std::string evil = "a,\"b\" _&%$# \n<script>alert(1)</script> \\|";
  const TempFolder folder;
  const auto truth =
      folder.write("truth.json", json{{"phases", {{{"name", evil}, {"start_s", 0}, {"end_s", 0.3}}}}}.dump());
  const auto config =
      folder.write("config.json", json{{"methods", {{{"label", evil}, {"method", "esi"}}}}}.dump());
  const auto result = evaluate(
      folder / "out", quoted(flight_start()) + " --config " + quoted(config) + " -g " + quoted(truth));
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  for (const char* const name : {"table.csv", "frames.csv"}) {
    const Row row = csv_rows(folder / "out" / name).at(0);
    CHECK(row.at("method") == evil);
    CHECK(row.at("phase") == evil);
  }
  CHECK(report_of(folder / "out")["results"][0]["methods"][0]["phases"][0]["name"] == evil);
  check_page(folder / "out" / "report.html");
  const std::string markdown = content_of(folder / "out" / "table.md");
  CHECK(std::count(markdown.begin(), markdown.end(), '\n') == 6);  // caption, table of one row, blanks
  CHECK_THAT(markdown, Contains("&lt;script&gt;") && Contains("\\|"));
  CHECK_THAT(content_of(folder / "out" / "table.tex"),
             Contains("\\_\\&\\%\\$\\#") && !Contains("<script>") && Contains("\\textbackslash{}|"));
}

TEST_CASE("a printed config makes the same report") {
  const TempFolder folder;
  const std::string options = " --method esi --stride 2 --fps 50 --no-tracking";
  const auto printed = run_shell(eval() + options + " --print-config");
  REQUIRE(printed.exit_code == 0);
  const auto config = folder.write("config.json", printed.out);
  const auto again = run_shell(eval() + " --config " + quoted(config) + " --print-config");
  CHECK(again.out == printed.out);
  REQUIRE(evaluate(folder / "a", quoted(flight_start()) + options).exit_code == 0);
  REQUIRE(evaluate(folder / "b", quoted(flight_start()) + " --config " + quoted(config)).exit_code == 0);
  for (const char* const name : {"table.csv", "frames.csv", "detections.csv"}) {
    CHECK((content_of(folder / "a" / name) == content_of(folder / "b" / name)));
  }
  CHECK(csv_rows(folder / "a" / "frames.csv").size() == 5);
  CHECK_FALSE(fs::exists(folder / "a" / "truth_0.tum"));
}
