#pragma once

#include <optional>
#include <string>
#include <vector>

#include "esi/eval/score.hpp"
#include "esi/eval/tracking.hpp"
#include "esi/pipeline/evaluation/evaluate.hpp"

namespace esi {

/// Means over the frames that have a clean one beside them.
struct QualitySummary {
  std::string phase;
  std::int64_t frames = 0;
  std::optional<double> ssim, ssim_fitted, psnr_db, sharpness;
};

/// What a method reached on one input, or on all together.
struct MethodResult {
  std::string label;
  Score score;
  std::vector<QualitySummary> quality;  ///< by phase, then in total; empty without clean frames
  std::optional<TrackingRun> tracking_run;
  std::optional<TrackingScore> tracking;  ///< where truth has camera and poses, and methods are not pooled
};

struct InputResult {
  std::string name;  ///< the input's path, "all" for all together
  std::vector<MethodResult> methods;
  bool is_pooled = false;
};

/// Each input's results; where there are several, and their truths expect the same tags, first those of all
/// together: phases of one name as one, whatever the recording.
std::vector<InputResult> results_of(const Evaluation& evaluation, const EvalConfig& config);

}  // namespace esi
