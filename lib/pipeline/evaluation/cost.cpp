#include "esi/pipeline/evaluation/cost.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <numeric>

namespace esi {
namespace {

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void add_cost(std::vector<std::string>& row, const std::optional<FrameCost>& cost) {
  for (const double FrameCost::*field :
       {&FrameCost::mean_ms, &FrameCost::median_ms, &FrameCost::p95_ms, &FrameCost::max_ms}) {
    row.push_back(cost ? fmt::format("{:.4f}", (*cost).*field) : "");
  }
}

std::vector<std::string> cost_row(const InputRun& input, const MethodRun& run) {
  const auto making = frame_cost(run.reconstruction_ms);
  const auto finding = frame_cost(run.detection_ms);
  const double events = input.digest ? static_cast<double>(input.digest->events()) : 0.0;
  std::vector<std::string> row = {input.input.path.string(), run.label, std::to_string(run.frames.size()),
                                  fmt::format("{:.0f}", events), fmt::format("{:.6f}", input.duration_s)};
  const auto ratio = [](double a, double b) {
    return b > 0.0 ? fmt::format("{:.3f}", a / b) : std::string();
  };
  row.push_back(making ? ratio(events * 1e-6, making->sum_s) : "");
  row.push_back(making ? ratio(input.duration_s, making->sum_s) : "");
  row.push_back(ratio(static_cast<double>(run.frames.size()), input.duration_s));
  add_cost(row, making);
  add_cost(row, finding);
  return row;
}

}  // namespace

std::optional<FrameCost> frame_cost(const std::vector<double>& frame_ms) {
  if (frame_ms.empty()) return std::nullopt;
  FrameCost cost;
  const double sum_ms = std::accumulate(frame_ms.begin(), frame_ms.end(), 0.0);
  cost.sum_s = 1e-3 * sum_ms;
  cost.mean_ms = sum_ms / static_cast<double>(frame_ms.size());
  cost.median_ms = *quantile(frame_ms, 0.5);
  cost.p95_ms = *quantile(frame_ms, 0.95);
  cost.max_ms = *std::max_element(frame_ms.begin(), frame_ms.end());
  return cost;
}

Table cost_rows(const Evaluation& evaluation, int threads, double wall_s) {
  Table table{
      "",
      {"input", "method", "frames", "events", "duration_s", "mev_s", "times_real_time", "frames_per_s"},
      {}};
  for (const char* const what : {"reconstruction", "detection"}) {
    for (const char* const column : {"mean", "median", "p95", "max"}) {
      table.columns.push_back(fmt::format("{}_ms_{}", what, column));
    }
  }
  for (const char* const column : {"peak_memory_mb", "threads", "wall_s"}) table.columns.emplace_back(column);
  for (const InputRun& input : evaluation.inputs) {
    for (const MethodRun& run : input.methods) {
      auto& row = table.rows.emplace_back(cost_row(input, run));
      row.push_back(fmt::format("{:.1f}", peak_memory_mb()));
      row.push_back(std::to_string(threads));
      row.push_back(fmt::format("{:.3f}", wall_s));
    }
  }
  return table;
}

}  // namespace esi
