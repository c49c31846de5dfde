#pragma once

#include <string>
#include <vector>

#include "esi/pipeline/evaluation/results.hpp"

namespace esi {

/// The evaluation as one HTML page that needs nothing else: tables, a timeline of detections, frames found
/// and missed, tracking errors over time, cost.
std::string report_page(const Evaluation& evaluation, const std::vector<InputResult>& results,
                        const EvalConfig& config, const std::string& tool);

}  // namespace esi
