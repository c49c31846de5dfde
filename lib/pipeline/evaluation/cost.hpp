#pragma once

#include <optional>
#include <string>
#include <vector>

#include "esi/pipeline/evaluation/evaluate.hpp"
#include "esi/report/table.hpp"

namespace esi {

/// Of a cost per frame, ms of processor time.
struct FrameCost {
  double mean_ms = 0.0, median_ms = 0.0, p95_ms = 0.0, max_ms = 0.0, sum_s = 0.0;
};
/// Nothing for no frames.
std::optional<FrameCost> frame_cost(const std::vector<double>& frame_ms);

/// What each method cost on each input (cost.csv): the paper's runtime and temporal resolution. Processor
/// time of the thread that did the work, so that it hardly depends on what else runs; peak memory is the
/// whole program's.
Table cost_rows(const Evaluation& evaluation, int threads, double wall_s);

}  // namespace esi
