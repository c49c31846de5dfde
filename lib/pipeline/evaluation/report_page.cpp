#include "esi/pipeline/evaluation/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "esi/core/json_text.hpp"
#include "esi/pipeline/evaluation/cost.hpp"
#include "esi/pipeline/evaluation/result_tables.hpp"
#include "esi/pipeline/evaluation/sample_strip.hpp"
#include "esi/report/chart.hpp"
#include "esi/report/html_page.hpp"
#include "esi/report/timeline.hpp"

namespace esi {
namespace {

constexpr std::size_t kMostPlotPoints = 400;

Svg timeline_of(const InputRun& input, const InputResult& result) {
  std::vector<TimelineRow> rows;
  for (const MethodResult& method : result.methods) {
    TimelineRow& row = rows.emplace_back();
    row.name = method.label;
    for (const FrameScore& frame : method.score.frames) {
      row.t_us.push_back(frame.t_us);
      row.is_hit.push_back(frame.is_detected);
    }
  }
  return timeline(input.truth.truth.phases, rows);
}

/// Mean error of the relative position in short parts of the recording, of two frames at least; NaN without a
/// track.
Series error_series(const InputRun& input, const MethodResult& method, const PoseTrack& camera,
                    const PoseTrack& target) {
  Series series;
  series.name = method.label;
  const auto& phases = input.truth.truth.phases;
  const double begin_s = static_cast<double>(phases.front().interval.begin_us) * 1e-6;
  const double end_s = static_cast<double>(phases.back().interval.end_us) * 1e-6;
  const std::size_t parts =
      std::clamp<std::size_t>(method.tracking_run->frames.size() / 2, 1, kMostPlotPoints);
  std::vector<double> sums(parts, 0.0), counts(parts, 0.0);
  for (const TrackedFrame& frame : method.tracking_run->frames) {
    const auto from = camera.at(frame.t_us), to = target.at(frame.t_us);
    const double share = (static_cast<double>(frame.t_us) * 1e-6 - begin_s) / (end_s - begin_s);
    if (!frame.relative_m || !from || !to || share < 0.0 || share >= 1.0) continue;
    const auto part = static_cast<std::size_t>(share * static_cast<double>(parts));
    sums[part] += cv::norm(*frame.relative_m - (to->position_m - from->position_m));
    counts[part] += 1.0;
  }
  for (std::size_t i = 0; i < parts; ++i) {
    series.x.push_back(begin_s +
                       (static_cast<double>(i) + 0.5) / static_cast<double>(parts) * (end_s - begin_s));
    series.y.push_back(counts[i] > 0.0 ? sums[i] / counts[i] : NAN);
  }
  return series;
}

void add_tracking(HtmlPage& page, const InputRun& input, const InputResult& result) {
  const Table table = tracking_table(result);
  if (table.rows.empty()) return;
  page.table(table);
  const PoseTrack camera(input.truth.camera_poses), target(input.truth.target_poses);
  std::vector<Series> all;
  std::vector<double> values = {0.0};
  for (const MethodResult& method : result.methods) {
    if (!method.tracking_run) continue;
    all.push_back(error_series(input, method, camera, target));
    for (const double y : all.back().y) {
      if (std::isfinite(y)) values.push_back(y);
    }
  }
  Axis x{"time (s)", all.front().x.front(), all.front().x.back(), false};
  page.drawing(
      line_chart(x, axis_around("error (m)", values), all, 900.0, 300.0),
      "Error of the target's position relative to the camera, in the mean over short times; no line where "
      "there is no track.");
}

void add_samples(HtmlPage& page, const InputRun& input) {
  for (const MethodRun& run : input.methods) {
    const auto png = sample_strip(run);
    if (!png.empty()) {
      page.picture(png, run.label + ". " + sample_text(run, input.truth.truth.phases));
    }
  }
}

void add_cost(HtmlPage& page, const InputRun& input) {
  std::vector<Bar> bars;
  std::vector<double> values;
  for (const MethodRun& run : input.methods) {
    const auto cost = frame_cost(run.reconstruction_ms);
    if (!cost) continue;
    bars.push_back({run.label, cost->mean_ms, fmt::format("{:.2f} ms", cost->mean_ms)});
    values.push_back(cost->mean_ms);
  }
  if (bars.empty()) return;
  values.push_back(0.0);
  page.drawing(
      bar_chart(axis_around("ms of processor time for each frame, its events included", values), bars),
      "What reconstruction costs (cost.csv has the rest; this figure differs from run to run).");
}

void add_input(HtmlPage& page, const InputRun& input, const InputResult& result) {
  page.heading(result.name);
  page.table(rate_table(result));
  page.drawing(timeline_of(input, result), "Frames with a tag found (blue) and without (grey), over time.");
  if (const Table table = quality_table(result); !table.rows.empty()) page.table(table);
  add_tracking(page, input, result);
  add_samples(page, input);
  add_cost(page, input);
}

}  // namespace

std::string report_page(const Evaluation& evaluation, const std::vector<InputResult>& results,
                        const EvalConfig& config, const std::string& tool) {
  HtmlPage page("Evaluation by " + tool);
  page.paragraph(
      "Rates are detected frames of a phase's frames, with Wilson's 95 % interval, which takes frames for "
      "independent, and beside it that of a moving-block bootstrap, which doesn't. A frame is detected where "
      "an "
      "expected tag is decoded and, where the truth has corners, lies within the limit of them.");
  if (results.size() > evaluation.inputs.size()) {
    page.heading("All inputs together");
    page.table(rate_table(results.front()));
  }
  for (std::size_t i = 0; i < evaluation.inputs.size(); ++i) {
    add_input(page, evaluation.inputs[i], results[results.size() - evaluation.inputs.size() + i]);
  }
  page.heading("Parameters");
  page.code(json_text(config.json()));
  return page.str();
}

}  // namespace esi
