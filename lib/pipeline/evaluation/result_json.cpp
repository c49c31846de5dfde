#include "esi/pipeline/evaluation/result_json.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "esi/pipeline/evaluation/rate_json.hpp"

namespace esi {
namespace {

using nlohmann::json;

json seconds_json(const std::optional<std::int64_t>& t_us) {
  return t_us ? json(static_cast<double>(*t_us) * 1e-6) : json();
}

json tag_json(const TagScore& tags) {
  return {{"instances", rate_json(tags.instances)},
          {"corner_error_px",
           {{"median", or_null(tags.corner_error_median_px)},
            {"mean", or_null(tags.corner_error_mean_px)},
            {"p95", or_null(tags.corner_error_p95_px)}}},
          {"margin_median", or_null(tags.margin_median)},
          {"hamming", tags.hamming},
          {"unverified", tags.unverified},
          {"first_found_s", seconds_json(tags.first_found_us)},
          {"longest_gap_s", seconds_json(tags.longest_gap_us)}};
}

json phase_json(const PhaseScore& phase) {
  json by_id = json::object();
  for (const auto& [id, tags] : phase.by_id) by_id[std::to_string(id)] = tag_json(tags);
  return {{"name", phase.name},
          {"duration_s", static_cast<double>(phase.duration_us) * 1e-6},
          {"frames", rate_json(phase.frames)},
          {"reason", phase.reason.empty() ? json() : json(phase.reason)},
          {"bootstrap95", interval_json(phase.bootstrap)},
          {"false_detections",
           {{"foreign", phase.wrong.foreign},
            {"misplaced", phase.wrong.misplaced},
            {"duplicate", phase.wrong.duplicate}}},
          {"tags", tag_json(phase.tags)},
          {"by_id", by_id}};
}

json quality_json(const std::vector<QualitySummary>& summaries) {
  json list = json::array();
  for (const QualitySummary& summary : summaries) {
    list.push_back({{"phase", summary.phase},
                    {"frames", summary.frames},
                    {"ssim", or_null(summary.ssim)},
                    {"ssim_fitted", or_null(summary.ssim_fitted)},
                    {"psnr_db", or_null(summary.psnr_db)},
                    {"sharpness", or_null(summary.sharpness)}});
  }
  return list;
}

json tracking_phase_json(const PhaseTracking& phase) {
  return {{"name", phase.name},
          {"available", rate_json(phase.available)},
          {"rmse_m", or_null(phase.rmse_m)},
          {"error_median_m", or_null(phase.error_median_m)},
          {"error_max_m", or_null(phase.error_max_m)},
          {"longest_gap_s", seconds_json(phase.longest_gap_us)},
          {"reason", phase.reason.empty() ? json() : json(phase.reason)}};
}

json tracking_json(const MethodResult& method) {
  if (!method.tracking) return nullptr;
  json phases = json::array();
  for (const PhaseTracking& phase : method.tracking->phases) phases.push_back(tracking_phase_json(phase));
  const TrackingRun& run = *method.tracking_run;
  return {{"phases", phases},
          {"total", tracking_phase_json(method.tracking->total)},
          {"measurements", {{"used", run.used}, {"gated", run.gated}, {"unusable", run.unusable}}},
          {"starts", run.starts}};
}

}  // namespace

json to_json(const InputResult& result) {
  json methods = json::array();
  for (const MethodResult& method : result.methods) {
    json phases = json::array();
    for (const PhaseScore& phase : method.score.phases) phases.push_back(phase_json(phase));
    methods.push_back({{"method", method.label},
                       {"phases", phases},
                       {"total", phase_json(method.score.total)},
                       {"frames_outside_phases", method.score.frames_outside},
                       {"quality", quality_json(method.quality)},
                       {"tracking", tracking_json(method)}});
  }
  return {{"input", result.name}, {"methods", methods}};
}

}  // namespace esi
