#include "esi/sweep/sweep_files.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/report/svg_picture.hpp"
#include "esi/sweep/sweep_json.hpp"
#include "esi/sweep/sweep_page.hpp"
#include "esi/sweep/sweep_tables.hpp"

namespace esi {
namespace {

constexpr const char* kCurves = "curves";
constexpr const char* kHeatMaps = "heat_maps";

void add_pictures(std::vector<SweepFile>& files, const std::string& folder,
                  const std::vector<SweepFigure>& figures) {
  for (const SweepFigure& figure : figures) {
    files.push_back({folder + "/" + figure.name + ".png", png_of(figure.svg)});
  }
}

}  // namespace

std::vector<SweepFile> sweep_files(const SweepOutcome& outcome, const nlohmann::json& best_config,
                                   const std::string& how) {
  const SweepFigures figures{curve_figures(outcome), heat_map_figures(outcome)};
  const Table best = sweep_table(outcome, kShownCells);
  std::vector<SweepFile> files;
  files.push_back({"table.csv", to_csv(sweep_rows(outcome))});
  files.push_back({"table.md", to_markdown(best)});
  files.push_back({"table.tex", to_tex(best)});
  files.push_back({"table.json", json_text(to_json(outcome))});
  files.push_back({"best.json", json_text(best_config)});
  add_pictures(files, kCurves, figures.curves);
  add_pictures(files, kHeatMaps, figures.heat_maps);
  files.push_back({"report.html", sweep_page(outcome, figures, best_config, how)});
  return files;
}

void write_sweep_files(const std::filesystem::path& folder, const SweepOutcome& outcome,
                       const nlohmann::json& best_config, const std::string& how) {
  for (const SweepFile& file : sweep_files(outcome, best_config, how)) {
    const std::filesystem::path path = folder / file.name;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) throw system_error(path.parent_path().string(), "cannot be created", error.value());
    write_file(path, file.bytes);
  }
}

bool is_sweep_file(std::string_view name) {
  constexpr std::array<std::string_view, 6> kNames = {"table.csv",  "table.md",  "table.tex",
                                                      "table.json", "best.json", "report.html"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool is_sweep_folder(std::string_view name) { return name == kCurves || name == kHeatMaps; }

}  // namespace esi
