// What the real esi-eval writes, against counts of its own.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <pugixml.hpp>
#include <set>

#include "apps/eval_command.hpp"
#include "support/folder_digest.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

using Row = std::map<std::string, std::string>;

/// Four corners a tag has in corners.csv at exactly that time; nothing where it has no row.
using Truth = std::map<std::pair<std::int64_t, std::string>, std::array<double, 8>>;

Truth true_corners(const fs::path& file) {
  Truth truth;
  for (const Row& row : csv_rows(file)) {
    auto& corners = truth[{std::llround(1e6 * std::stod(row.at("t_s"))), row.at("id")}];
    for (std::size_t k = 0; k < 8; ++k) {
      corners[k] = std::stod(row.at((k % 2 == 0 ? "x" : "y") + std::to_string(k / 2 + 1)));
    }
  }
  return truth;
}

/// Whether all four corners lie within 5 px of the truth, in any of the four rotations.
bool is_in_place(const Row& row, const std::array<double, 8>& truth) {
  for (std::size_t turn = 0; turn < 4; ++turn) {
    double farthest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t other = 2 * ((k + turn) % 4);
      const std::string n = std::to_string(k + 1);
      farthest = std::max(farthest, std::hypot(std::stod(row.at("x" + n)) - truth[other],
                                               std::stod(row.at("y" + n)) - truth[other + 1]));
    }
    if (farthest <= 5.0) return true;
  }
  return false;
}

struct Counts {
  int frames = 0, detected = 0, wrong = 0;
  bool operator==(const Counts&) const = default;
};
using CountsByPhase = std::map<std::array<std::string, 3>, Counts>;

/// Frames by the truth's phases, detections by its corners.
CountsByPhase counted(const fs::path& out, const fs::path& flight_folder) {
  const json phases = json::parse(content_of(flight_folder / "ground_truth.json"))["phases"];
  const Truth truth = true_corners(flight_folder / "corners.csv");
  const auto phase_at = [&](std::int64_t t_us) -> std::string {
    for (const json& phase : phases) {
      const auto t_s = 1e-6 * static_cast<double>(t_us);
      if (phase["start_s"] <= t_s && t_s < phase["end_s"].get<double>()) return phase["name"];
    }
    return {};
  };
  std::set<std::array<std::string, 3>> found;
  CountsByPhase counts;
  for (const Row& row : csv_rows(out / "detections.csv")) {
    const std::int64_t t_us = std::stoll(row.at("t_us"));
    const std::string phase = phase_at(t_us);
    if (phase.empty()) continue;
    const auto corners = truth.find({t_us, row.at("id")});
    if (corners != truth.end() && is_in_place(row, corners->second)) {
      found.insert({row.at("input"), row.at("method"), row.at("frame")});
    } else {
      ++counts[{row.at("input"), row.at("method"), phase}].wrong;
    }
  }
  for (const Row& row : csv_rows(out / "frames.csv")) {
    const std::string phase = phase_at(std::stoll(row.at("t_us")));
    const bool is_found = found.count({row.at("input"), row.at("method"), row.at("frame")}) > 0;
    CHECK(row.at("phase") == phase);
    CHECK(row.at("detected") == (is_found && !phase.empty() ? "1" : "0"));
    if (phase.empty()) continue;
    Counts& count = counts[{row.at("input"), row.at("method"), phase}];
    ++count.frames;
    count.detected += is_found ? 1 : 0;
  }
  return counts;
}

std::int64_t number(const json& value) { return value.get<std::int64_t>(); }

/// The page is well formed, without scripts, and asks for nothing from elsewhere.
void check_page(const fs::path& file) {
  const std::string text = content_of(file);
  pugi::xml_document page;
  const auto result = page.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  INFO(result.description() << " at " << result.offset);
  REQUIRE(result);
  CHECK(page.select_nodes("//script | //iframe | //object").empty());
  for (const auto& node : page.select_nodes("//@src | //@href")) {
    CHECK(std::string(node.attribute().value()).starts_with("data:"));
  }
  CHECK_FALSE(page.select_nodes("//table").empty());
  CHECK_FALSE(page.select_nodes("//*[local-name()='svg']").empty());
  CHECK_FALSE(page.select_nodes("//img").empty());
  CHECK(text.find("@import") == std::string::npos);
  CHECK(text.find("url(") == std::string::npos);
}

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
