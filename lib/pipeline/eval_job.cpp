#include "esi/pipeline/eval_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/core/version.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/io/output/output_folder.hpp"
#include "esi/io/output/run_manifest.hpp"
#include "esi/pipeline/evaluation/cost.hpp"
#include "esi/pipeline/evaluation/report_page.hpp"
#include "esi/pipeline/evaluation/result_json.hpp"
#include "esi/pipeline/evaluation/result_tables.hpp"
#include "esi/pipeline/evaluation/tracks_output.hpp"
#include "esi/pipeline/stopwatch.hpp"

namespace esi {
namespace {

bool is_file_of_report(std::string_view name) {
  constexpr std::array<std::string_view, 10> kNames = {
      "report.json", "table.csv", "table.md",    "table.tex", "tags.csv",
      "frames.csv",  "cost.csv",  "report.html", "run.json",  "detections.csv"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end() || is_track_name(name);
}

bool has_no_folder(std::string_view /*name*/) { return false; }

constexpr FolderContent kReportContent{"an evaluation", is_file_of_report, has_no_folder, false};

SinkOptions sink_options(const EvalJob& job) {
  SinkOptions options;
  options.force = job.force;
  return options;
}

/// All that can be told before the work begins.
void check_job(const EvalJob& job, const std::vector<InputRun>& inputs, const EvalConfig& config) {
  config.check();
  const bool needs_methods = std::any_of(job.inputs.begin(), job.inputs.end(),
                                         [](const EvalInput& input) { return !input.is_frames; });
  if (needs_methods && config.methods.empty()) throw usage_error("say with --method what is to be evaluated");
  std::set<std::string> paths;
  for (const EvalInput& input : job.inputs) {
    if (!paths.insert(input.path.string()).second) {
      throw usage_error(fmt::format("{} is given twice", input.path.string()));
    }
  }
  for (const Requirement& requirement : job.requirements) require_known(requirement, inputs, config);
  require_usable_folder(job.output, sink_options(job), kReportContent);
}

nlohmann::json input_json(const InputRun& input) {
  nlohmann::json json = {{"path", input.input.path.string()}, {"ground_truth", input.input.truth.string()},
                         {"width", input.size.width_px},      {"height", input.size.height_px},
                         {"duration_s", input.duration_s},    {"expected_ids", input.truth.expected.ids},
                         {"lost", input.losses.text()}};
  if (input.digest) json["events"] = {{"count", input.digest->events()}, {"crc32", input.digest->crc32()}};
  return json;
}

class ReportFolder {
 public:
  ReportFolder(const EvalJob& job, const EvalConfig& config)
      : job_(job), config_(config), folder_(job.output, sink_options(job), "", kReportContent) {}

  void write(const Evaluation& evaluation, const std::vector<InputResult>& results, double wall_s) {
    put("table.csv", to_csv(score_rows(results)));
    put("tags.csv", to_csv(tag_rows(results)));
    put("frames.csv", to_csv(frame_rows(evaluation, results)));
    put("detections.csv", to_csv(detection_rows(evaluation, config_.detector.family)));
    std::string markdown, tex;
    for (const InputResult& result : results) {
      markdown += to_markdown(rate_table(result)) + "\n";
      tex += to_tex(rate_table(result)) + "\n";
    }
    put("table.md", markdown);
    put("table.tex", tex);
    put("cost.csv", to_csv(cost_rows(evaluation, job_.threads, wall_s)));
    write_tracks(folder_.path(), evaluation, results);
    put("report.html", report_page(evaluation, results, config_, fmt::format("{} {}", job_.tool, version())));
    const nlohmann::json run = to_json(RunManifest::Run{job_.threads, wall_s});
    put("report.json", json_text(report_json(evaluation, results, run)));
    folder_.complete(
        json_text({{"tool", job_.tool}, {"version", version()}, {"config", config_.json()}, {"run", run}}));
  }

 private:
  void put(const char* name, const std::string& text) { write_file(folder_.path() / name, text); }

  nlohmann::json report_json(const Evaluation& evaluation, const std::vector<InputResult>& results,
                             const nlohmann::json& run) const {
    nlohmann::json inputs = nlohmann::json::array(), found = nlohmann::json::array();
    for (const InputRun& input : evaluation.inputs) inputs.push_back(input_json(input));
    for (const InputResult& result : results) found.push_back(to_json(result));
    return {{"tool", job_.tool}, {"version", version()}, {"config", config_.json()},
            {"inputs", inputs},  {"results", found},     {"run", run}};
  }

  const EvalJob& job_;
  const EvalConfig& config_;
  OutputFolder folder_;
};

void summarise(const Evaluation& evaluation, const std::vector<InputResult>& results, const EvalJob& job,
               EvalReport& report) {
  for (const InputRun& input : evaluation.inputs) {
    if (!input.losses.any()) continue;
    report.has_losses = true;
    report.losses += fmt::format("{}{}: {}", report.losses.empty() ? "" : "; ", input.input.path.string(),
                                 input.losses.text());
  }
  const bool is_pooled = results.size() > evaluation.inputs.size();
  for (const InputResult& result : std::span(results).first(is_pooled ? 1 : results.size())) {
    report.summary += (report.summary.empty() ? "" : "\n") + to_markdown(rate_table(result));
  }
  for (const Requirement& requirement : job.requirements) {
    for (std::string& sentence : missed(requirement, results)) report.missed.push_back(std::move(sentence));
  }
}

}  // namespace

EvalReport run_job(const EvalJob& job, const EvalConfig& config, const Observer& observer) {
  const Stopwatch watch;
  std::vector<InputRun> inputs = load_inputs(config, job.inputs);
  check_job(job, inputs, config);
  const Evaluation evaluation = evaluate(config, std::move(inputs), job.threads, observer);
  EvalReport report;
  report.stopped = evaluation.stopped;
  if (report.stopped) return report;
  const std::vector<InputResult> results = results_of(evaluation, config);
  summarise(evaluation, results, job, report);
  ReportFolder(job, config).write(evaluation, results, watch.seconds());
  return report;
}

}  // namespace esi
