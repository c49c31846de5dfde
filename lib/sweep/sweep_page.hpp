#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "esi/sweep/sweep_figures.hpp"
#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

struct SweepFigures {
  std::vector<SweepFigure> curves, heat_maps;
};

/// report.html: what matters, the best cell and its config, the best cells, curves, heat maps, and how the
/// numbers were made (`how`, a paragraph a line). Needs nothing from elsewhere.
std::string sweep_page(const SweepOutcome& outcome, const SweepFigures& figures,
                       const nlohmann::json& best_config, const std::string& how);

}  // namespace esi
