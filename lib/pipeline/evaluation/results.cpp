#include "esi/pipeline/evaluation/results.hpp"

#include <algorithm>

#include "esi/pipeline/evaluation/pooling.hpp"

namespace esi {
namespace {

QualitySummary summary_of(const std::string& name, const std::vector<FrameQuality>& frames) {
  std::vector<double> ssim, ssim_fitted, psnr_db, sharpness;
  for (const FrameQuality& frame : frames) {
    ssim.push_back(frame.quality->ssim);
    ssim_fitted.push_back(frame.quality->ssim_fitted);
    if (frame.quality->fit.psnr_db) psnr_db.push_back(*frame.quality->fit.psnr_db);
    if (frame.sharpness) sharpness.push_back(*frame.sharpness);
  }
  return {name,          static_cast<std::int64_t>(frames.size()),
          mean(ssim),    mean(ssim_fitted),
          mean(psnr_db), mean(sharpness)};
}

std::vector<QualitySummary> quality_of(const MethodRun& run, const std::vector<Phase>& phases) {
  std::vector<QualitySummary> summaries;
  if (run.quality.empty()) return summaries;
  for (const Phase& phase : phases) {
    std::vector<FrameQuality> inside;
    std::copy_if(run.quality.begin(), run.quality.end(), std::back_inserter(inside),
                 [&](const FrameQuality& frame) { return phase.interval.contains(frame.t_us); });
    summaries.push_back(summary_of(phase.name, inside));
  }
  summaries.push_back(summary_of("total", run.quality));
  return summaries;
}

void track(const InputRun& input, const MethodRun& run, const EvalConfig& config, MethodResult& result) {
  const LoadedTruth& truth = input.truth;
  if (!truth.has_tracks() || !truth.truth.tags) return;
  const CameraModel& camera = *truth.truth.camera;
  const PoseTrack true_camera(truth.camera_poses), true_target(truth.target_poses);
  const auto tags = locate_tags(*truth.truth.tags, truth.corner_rows, camera, true_camera, true_target);
  if (tags.empty()) return;
  const PoseTrack believed(with_noise(truth.camera_poses, config.pose_noise));
  result.tracking_run = track_target(run.frames, tags, camera, believed, config.tracking);
  result.tracking =
      score_tracking(truth.truth.phases, *result.tracking_run, true_camera, true_target, config.tracking);
}

InputResult result_of(const InputRun& input, const EvalConfig& config) {
  InputResult result{input.input.path.string(), {}, false};
  for (const MethodRun& run : input.methods) {
    MethodResult& method = result.methods.emplace_back();
    method.label = run.label;
    method.score = score(input.truth.truth.phases, input.truth.expected, input.truth.corner_track(),
                         run.frames, config.score);
    method.quality = quality_of(run, input.truth.truth.phases);
    track(input, run, config, method);
  }
  return result;
}

}  // namespace

std::vector<InputResult> results_of(const Evaluation& evaluation, const EvalConfig& config) {
  std::vector<InputResult> results;
  if (auto pooled = pooled_scores(evaluation.inputs, config.score); !pooled.empty()) {
    InputResult& all = results.emplace_back();
    all.name = "all";
    all.is_pooled = true;
    for (auto& [label, score] : pooled) {
      MethodResult& method = all.methods.emplace_back();
      method.label = label;
      method.score = std::move(score);
    }
  }
  for (const InputRun& input : evaluation.inputs) results.push_back(result_of(input, config));
  return results;
}

}  // namespace esi
