#include "esi/sweep/sweep_report.hpp"

#include <fmt/format.h>

#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/sweep/main_effects.hpp"
#include "esi/sweep/sweep_files.hpp"
#include "esi/sweep/sweep_folder.hpp"
#include "esi/sweep/sweep_results.hpp"

namespace esi {
namespace {

std::string how_text(const SweepHeader& header, const SweepOutcome& outcome) {
  const SweepConfig& config = header.config;
  std::string text =
      fmt::format("{} cells of method {} on {} recording{}: ", outcome.grid.cells(), outcome.method,
                  header.recordings.size(), header.recordings.size() == 1 ? "" : "s");
  for (const SweptRecording& recording : header.recordings) {
    text += fmt::format("{} ({} events, CRC-32 {}), ", recording.path, recording.events, recording.crc32);
  }
  text += fmt::format("one frame of {} judged. ", config.judging.stride);
  if (config.search.search == SearchOptions::Search::halving) {
    text += fmt::format(
        "Search by halving from one frame of {} on: cells that were dropped saw fewer frames; the interval "
        "of "
        "their difference to the best says how much better they might be. ",
        config.search.first_stride * config.judging.stride);
  }
  return text + fmt::format(
                    "The best cell has the highest rate in {}; it was chosen on these very frames, so "
                    "that its rate flatters it.",
                    outcome.objective == "total" ? "all phases together" : outcome.objective);
}

std::string summary_text(const SweepHeader& header, const SweepOutcome& outcome) {
  const CellOutcome& best = outcome.cells[outcome.best];
  const Rate& rate = rate_in(best, objective_phase(outcome)).frames;
  std::string text =
      fmt::format("best of {} cells: {}: {} of {} frames ({:.1f} %)\n", outcome.grid.cells(),
                  header.config.base.method().name, rate.hits, rate.of, 100.0 * rate.value().value_or(0.0));
  if (!outcome.grid.axes().empty()) text += fmt::format("  {}\n", outcome.grid.text(outcome.best));
  for (const std::string& sentence : main_effects(outcome)) text += "- " + sentence + "\n";
  return text;
}

}  // namespace

std::string write_results(const std::filesystem::path& folder, const std::string& tool,
                          const SweepHeader& header, const std::vector<CellRecord>& records,
                          const RunManifest::Run& run) {
  const SweepOutcome outcome = outcome_of(header, records);
  nlohmann::json best = header.config.cell_config(outcome.grid, outcome.best).json();
  for (const char* key : {"force", "resume"}) best.erase(key);
  write_sweep_files(folder, outcome, best, how_text(header, outcome));
  write_file(
      folder / kRunName,
      json_text(
          {{"tool", tool}, {"sweep", to_json(header)}, {"lost", losses_of(header)}, {"run", to_json(run)}}));
  return summary_text(header, outcome);
}

}  // namespace esi
