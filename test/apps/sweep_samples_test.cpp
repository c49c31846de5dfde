// The small sweep of configs/sweep, through the real binaries.
#include <catch2/catch.hpp>

#include "apps/eval_command.hpp"
#include "apps/report_page.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

using Row = std::map<std::string, std::string>;

json json_in(const fs::path& file) { return json::parse(content_of(file)); }

}  // namespace

TEST_CASE("the sweep of the samples has every result, and its best config keeps what it promised") {
  const TempFolder folder;
  const fs::path out = folder / "sweep";
  const auto swept = run_shell(quoted(tool("esi-sweep")) + " --config " +
                               quoted(source_dir() / "configs/sweep/samples.json") + " -o " + quoted(out));
  CAPTURE(swept.err);
  REQUIRE(swept.exit_code == 0);
  CHECK_THAT(swept.out, StartsWith("best of 9 cells: esi: ") && Contains("tau_s"));
  for (const char* const name :
       {"cells.jsonl", "sweep.json", "run.json", "table.csv", "table.md", "table.tex", "table.json",
        "curves/tau_s.png", "curves/clamp.png", "heat_maps/tau_s-clamp.png"}) {
    CHECK(fs::file_size(out / name) > 0);
  }
  check_page(out / "report.html");

  // What esi-recon and esi-eval make of the best config is the row of the best cell, recording by recording.
  const std::string best = std::to_string(json_in(out / "table.json")["best"]["cell"].get<int>());
  int compared = 0;
  for (const Row& row : csv_rows(out / "table.csv")) {
    if (row.at("cell") != best || row.at("phase") != "total" || row.at("recording") == "all") continue;
    const fs::path recording = row.at("recording"), frames = folder / ("frames" + std::to_string(compared));
    REQUIRE(run_shell(quoted(tool("esi-recon")) + " " + quoted(recording) + " --size 128x96 --config " +
                      quoted(out / "best.json") + " --quiet -o " + quoted(frames))
                .exit_code == 0);
    const fs::path report = folder / ("report" + std::to_string(compared));
    REQUIRE(run_shell(eval() + " --frames " + quoted(frames) + " -g " +
                      quoted(recording.parent_path() / "ground_truth.json") + " --stride 5 --no-quality -o " +
                      quoted(report))
                .exit_code == 0);
    for (const Row& judged : csv_rows(report / "table.csv")) {
      if (judged.at("phase") != "total") continue;
      CHECK(judged.at("frames") == row.at("frames"));
      CHECK(judged.at("detected") == row.at("detected"));
      ++compared;
    }
  }
  CHECK(compared == 2);
}
