#include "esi/sweep/sweep_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "esi/core/json_text.hpp"
#include "esi/pipeline/evaluation/number_texts.hpp"
#include "esi/report/html_page.hpp"
#include "esi/sweep/main_effects.hpp"
#include "esi/sweep/sweep_tables.hpp"

namespace esi {
namespace {

void add_effects(HtmlPage& page, const SweepOutcome& outcome) {
  page.heading("What matters");
  const std::vector<std::string> sentences = main_effects(outcome);
  if (sentences.empty()) page.paragraph("No parameter had more than one value.");
  for (const std::string& sentence : sentences) page.paragraph(sentence);
  page.paragraph(fmt::format(
      "This is about the rate in {}. Points are percentage points: the rate of the best cell with one value "
      "changed, less its own, on the same frames. The best cell was chosen by these frames, so that others "
      "stand a little worse here than they would on new ones.",
      outcome.objective));
}

void add_best(HtmlPage& page, const SweepOutcome& outcome, const nlohmann::json& config) {
  const CellOutcome& best = outcome.cells[outcome.best];
  const SweepRate& rate = rate_in(best, objective_phase(outcome));
  page.heading("The best cell");
  page.paragraph(fmt::format(
      "Cell {} of {} cells (the first is 0): {}. In {} it has {} of frames, 95 % {} by blocks of frames in a "
      "row and {} if frames were independent (Wilson).",
      outcome.best, outcome.cells.size(), outcome.grid.text(outcome.best), outcome.objective,
      share_text(rate.frames), percent_range_text(rate.bootstrap), percent_range_text(rate.frames.wilson())));
  if (outcome.recordings.size() > 1) page.table(best_by_recording(outcome));
  page.paragraph("best.json, a config for esi-recon:");
  page.code(json_text(config));
}

void add_figures(HtmlPage& page, const SweepOutcome& outcome, const SweepFigures& figures) {
  if (was_searched(outcome)) {
    page.paragraph(fmt::format(
        "Cells that the search dropped saw fewer frames. In {} they are shown at the best cell's rate plus "
        "their difference to it on frames of both, in other figures at their own rate; a highest rate is one "
        "of cells that saw all frames where there are such.",
        outcome.objective));
  }
  if (!figures.curves.empty()) page.heading("One parameter at a time");
  for (const SweepFigure& figure : figures.curves) page.drawing(figure.svg, figure.caption);
  const std::string left_out = left_out_heat_maps(outcome);
  if (!figures.heat_maps.empty()) page.heading("Two parameters at a time");
  if (!left_out.empty()) page.paragraph(left_out);
  for (const SweepFigure& figure : figures.heat_maps) page.drawing(figure.svg, figure.caption);
}

void add_lines(HtmlPage& page, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) page.paragraph(line);
  }
}

}  // namespace

std::string sweep_page(const SweepOutcome& outcome, const SweepFigures& figures,
                       const nlohmann::json& best_config, const std::string& how) {
  HtmlPage page("Parameter sweep of " + outcome.method);
  add_effects(page, outcome);
  add_best(page, outcome, best_config);
  page.heading("The best cells");
  page.table(sweep_table(outcome, kShownCells));
  add_figures(page, outcome, figures);
  page.heading("How the numbers were made");
  add_lines(page, how);
  return page.str();
}

}  // namespace esi
