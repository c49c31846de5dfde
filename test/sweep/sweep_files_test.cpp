#include "esi/sweep/sweep_files.hpp"

#include <sys/stat.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <pugixml.hpp>
#include <set>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/recon_config.hpp"
#include "support/temp_folder.hpp"
#include "sweep/made_sweep.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

const std::string kHow = "Made by esi-sweep of <b>two</b> recordings.\n\nBlocks of 1 s, 2000 resamples.";

json config_of_best() {
  ReconConfig config;
  config.choose_method("esi");
  config.set("tau_s=4");
  return config.json();
}

std::string content_of(const std::vector<SweepFile>& files, const std::string& name) {
  for (const SweepFile& file : files) {
    if (file.name == name) return file.bytes;
  }
  FAIL("no file " + name);
  return {};
}

const std::vector<SweepFile>& usual_files() {
  static const std::vector<SweepFile> files = sweep_files(usual_sweep(), config_of_best(), kHow);
  return files;
}

}  // namespace

TEST_CASE("a sweep writes its tables, its page, its best config and every figure, and the same bytes again") {
  const TempFolder folder;
  write_sweep_files(folder / "out", usual_sweep(), config_of_best(), kHow);
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    const std::string name = fs::relative(entry.path(), folder / "out");
    if (entry.is_directory()) {
      CHECK(is_sweep_folder(name));
      continue;
    }
    names.insert(name);
    const bool is_inside = entry.path().parent_path() != folder / "out";
    CHECK(is_sweep_file(name) != is_inside);
    CHECK((read_text_file(entry.path()) == content_of(usual_files(), name)));
  }
  CHECK(names.size() == 6 + 3 + 9);
  CHECK(names.size() == usual_files().size());
  for (const char* const name : {"curves/tau_s.png", "curves/readout_decay.png", "heat_maps/tau_s-form.png",
                                 "heat_maps/form-readout_decay-1-straight.png"}) {
    CHECK(names.count(name) == 1);
  }
}

TEST_CASE("a sweep's folder has no other names") {
  for (const char* const name : {"cells.jsonl", "run.json", "curves", "x.png", "table.csv.part"}) {
    CHECK_FALSE(is_sweep_file(name));
  }
  CHECK_FALSE(is_sweep_folder("table.csv"));
}

TEST_CASE("every picture can be decoded and shows something on white") {
  for (const SweepFile& file : usual_files()) {
    if (!file.name.ends_with(".png")) continue;
    CAPTURE(file.name);
    const std::vector<char> bytes(file.bytes.begin(), file.bytes.end());
    const cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
    REQUIRE(picture.cols >= 500);
    CHECK(picture.at<std::uint8_t>(0, 0) == 255);
    CHECK(cv::countNonZero(picture < 128) > 500);
    CHECK(cv::countNonZero(picture == 255) > picture.rows * picture.cols / 4);
  }
}

TEST_CASE("the sweep's page is well formed, asks for nothing from elsewhere and has what matters first") {
  const std::string text = content_of(usual_files(), "report.html");
  pugi::xml_document page;
  const auto result = page.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  INFO(result.description() << " at " << result.offset);
  REQUIRE(result);
  CHECK(page.select_nodes("//script | //iframe | //object | //b | //img").empty());
  for (const auto& node : page.select_nodes("//@src | //@href")) {
    CHECK(std::string(node.attribute().value()).starts_with("data:"));
  }
  CHECK(text.find("@import") == std::string::npos);
  CHECK(text.find("url(") == std::string::npos);
  CHECK(page.select_nodes("//*[local-name()='svg']").size() == 3 + 9);
  CHECK_THAT(page.select_node("//p").node().text().get(), Catch::StartsWith("tau_s matters: below 2 s"));
  for (const char* const part : {"4000 (86.3 %)", "readout_decay does not matter", "All 16 cells",
                                 "&quot;tau_s&quot;: 4.0", "&lt;b&gt;two&lt;/b&gt;", "2000 resamples",
                                 "Cell 12 of 16", "tau_s=4 form=exponential readout_decay=true alpha=0.3"}) {
    CHECK_THAT(text, Contains(part));
  }
  CHECK_THAT(text, Contains("The best cell in each recording"));
  CHECK_THAT(text, !Contains("search dropped"));
}

TEST_CASE("the page says how cells that the search dropped are shown") {
  SweepOutcome outcome = usual_sweep();
  drop(outcome, 0, 1);
  CHECK_THAT(content_of(sweep_files(outcome, config_of_best(), kHow), "report.html"),
             Contains("Cells that the search dropped saw fewer frames"));
}

TEST_CASE("the sweep's JSON holds every number") {
  const json found = parse_json(content_of(usual_files(), "table.json"), "table.json");
  const SweepOutcome outcome = usual_sweep();
  CHECK(found["objective"] == "total");
  CHECK(found["recordings"] == json{kEvilRecording, "second.aedat4"});
  CHECK(found["phases"] == json{"straight", kEvilPhase, "never"});
  CHECK(found["grid"][0] ==
        json{{"option", "tau_s"}, {"unit", "s"}, {"values", {0.5, 1, 2, 4}}, {"is_logarithmic", false}});
  CHECK(found["grid"][1]["values"] == json{"exponential", "power"});
  CHECK(found["best"] ==
        json{{"cell", 12},
             {"values", {{"tau_s", 4}, {"form", "exponential"}, {"readout_decay", "true"}, {"alpha", 0.3}}}});
  REQUIRE(found["cells"].size() == 16);
  REQUIRE(found["main_effects"].size() == 3);
  for (const CellOutcome& cell : outcome.cells) {
    const json& row = found["cells"][cell.cell];
    CHECK(row["cell"] == cell.cell);
    CHECK(row["all"]["total"]["frames"]["hits"] == cell.total.frames.hits);
    CHECK(row["all"]["phases"][1]["bootstrap95"][0] == cell.phases[1].bootstrap->low);
    CHECK(row["all"]["phases"][2]["frames"]["rate"].is_null());
    CHECK(row["all"]["phases"][2]["bootstrap95"].is_null());
    CHECK(row["recordings"][1]["phases"][0]["frames"]["hits"] == cell.by_recording[1][0].frames.hits);
    CHECK(row["recordings"][1]["total"]["false_detections"] == cell.totals[1].wrong);
    CHECK(row["recordings"][0]["total"]["corner_error_mean_px"] == *cell.totals[0].corner_error_px);
    CHECK(row["to_best"]["difference"] == *cell.to_best.difference);
    CHECK(row["dropped_after_round"].is_null());
  }
}

TEST_CASE("best.json is a config of esi-recon") {
  const TempFolder folder;
  ReconConfig config;
  config.load(folder.write("best.json", content_of(usual_files(), "best.json")));
  CHECK(config.json() == config_of_best());
  CHECK(config.json()["set"]["tau_s"] == 4);
}

TEST_CASE("names are escaped in the sweep's LaTeX and Markdown") {
  CHECK_THAT(content_of(usual_files(), "table.tex"), Contains("\\& 50 \\%\\_\\$\\#\\{\\}\\textbackslash{}") &&
                                                         Contains("readout\\_decay") &&
                                                         Contains("\\textless{}script"));
  CHECK_THAT(content_of(usual_files(), "table.md"), Contains("&lt;script&gt;") && Contains("\\|\\*\\`"));
}

TEST_CASE("a sweep's folder that can't be written is an error with its name") {
  const TempFolder folder;
  const fs::path file = folder.write("file", "");
  CHECK_THROWS_WITH(write_sweep_files(file, usual_sweep(), config_of_best(), kHow), Contains(file.string()));
}
