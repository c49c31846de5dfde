#include "esi/pipeline/evaluation/result_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "esi/pipeline/evaluation/number_texts.hpp"

namespace esi {
namespace {

using Row = std::vector<std::string>;

std::string seconds_of(const std::optional<std::int64_t>& t_us) {
  return t_us ? fmt::format("{:.6f}", static_cast<double>(*t_us) * 1e-6) : std::string();
}

std::string bits_of(const TagScore& tags, std::size_t bits) {
  return std::to_string(bits < tags.hamming.size() ? tags.hamming[bits] : 0);
}

const Row kTagColumns = {"tag_chances",
                         "tags_found",
                         "tag_rate",
                         "corner_error_median_px",
                         "corner_error_mean_px",
                         "corner_error_p95_px",
                         "margin_median",
                         "hamming0",
                         "hamming1",
                         "hamming2",
                         "first_found_s",
                         "longest_gap_s"};

void add_tag_numbers(Row& row, const TagScore& tags) {
  row.push_back(std::to_string(tags.instances.of));
  row.push_back(std::to_string(tags.instances.hits));
  row.push_back(decimal_text(tags.instances.value(), 6));
  row.push_back(decimal_text(tags.corner_error_median_px, 4));
  row.push_back(decimal_text(tags.corner_error_mean_px, 4));
  row.push_back(decimal_text(tags.corner_error_p95_px, 4));
  row.push_back(decimal_text(tags.margin_median, 3));
  for (std::size_t bits = 0; bits < 3; ++bits) row.push_back(bits_of(tags, bits));
  row.push_back(seconds_of(tags.first_found_us));
  row.push_back(seconds_of(tags.longest_gap_us));
}

Row score_row(const std::string& input, const std::string& method, const PhaseScore& phase) {
  Row row = {input,
             method,
             phase.name,
             std::to_string(phase.frames.of),
             std::to_string(phase.frames.hits),
             decimal_text(phase.frames.value(), 6)};
  add_interval(row, phase.frames.wilson());
  add_interval(row, phase.bootstrap);
  for (const std::int64_t count : {phase.wrong.foreign, phase.wrong.misplaced, phase.wrong.duplicate}) {
    row.push_back(std::to_string(count));
  }
  add_tag_numbers(row, phase.tags);
  row.push_back(phase.reason);
  return row;
}

/// Calls `visit(phase)` for each phase and the total.
template <class Visit>
void for_each_phase(const Score& score, Visit visit) {
  for (const PhaseScore& phase : score.phases) visit(phase);
  visit(score.total);
}

Row detection_row(const FrameDetections& frame, const Detection& tag, const std::string& family) {
  Row row = {std::to_string(frame.index),
             std::to_string(frame.t_us),
             family,
             std::to_string(tag.id),
             std::to_string(tag.hamming),
             fmt::format("{:.3f}", tag.margin),
             fmt::format("{:.3f}", tag.centre.x),
             fmt::format("{:.3f}", tag.centre.y)};
  for (const double value : tag.xy_px) row.push_back(fmt::format("{:.3f}", value));
  return row;
}

std::string phase_at(const std::vector<Phase>& phases, std::int64_t t_us) {
  for (const Phase& phase : phases) {
    if (phase.interval.contains(t_us)) return phase.name;
  }
  return {};
}

}  // namespace

Table rate_table(const InputResult& result) {
  Table table{result.name, {"method"}, {}};
  if (result.methods.empty()) return table;
  for_each_phase(result.methods.front().score,
                 [&](const PhaseScore& phase) { table.columns.push_back(phase.name); });
  for (const char* const column : {"95 % (Wilson)", "95 % (blocks)", "false", "corner error, px", "tags"}) {
    table.columns.emplace_back(column);
  }
  for (const MethodResult& method : result.methods) {
    Row& row = table.rows.emplace_back(Row{method.label});
    for_each_phase(method.score, [&](const PhaseScore& phase) { row.push_back(share_text(phase.frames)); });
    const PhaseScore& total = method.score.total;
    row.push_back(percent_range_text(total.frames.wilson()));
    row.push_back(percent_range_text(total.bootstrap));
    row.push_back(std::to_string(total.wrong.total()));
    row.push_back(total.tags.corner_error_median_px ? decimal_text(total.tags.corner_error_median_px, 2)
                                                    : "-");
    row.push_back(share_text(total.tags.instances));
  }
  return table;
}

Table score_rows(const std::vector<InputResult>& results) {
  Table table{"",
              {"input", "method", "phase", "frames", "detected", "rate", "wilson_low", "wilson_high",
               "bootstrap_low", "bootstrap_high", "false_foreign", "false_misplaced", "false_duplicate"},
              {}};
  table.columns.insert(table.columns.end(), kTagColumns.begin(), kTagColumns.end());
  table.columns.emplace_back("reason");
  for (const InputResult& result : results) {
    for (const MethodResult& method : result.methods) {
      for_each_phase(method.score, [&](const PhaseScore& phase) {
        table.rows.push_back(score_row(result.name, method.label, phase));
      });
    }
  }
  return table;
}

Table tag_rows(const std::vector<InputResult>& results) {
  Table table{"", {"input", "method", "phase", "id"}, {}};
  table.columns.insert(table.columns.end(), kTagColumns.begin(), kTagColumns.end());
  for (const InputResult& result : results) {
    for (const MethodResult& method : result.methods) {
      for_each_phase(method.score, [&](const PhaseScore& phase) {
        for (const auto& [id, tags] : phase.by_id) {
          Row& row = table.rows.emplace_back(Row{result.name, method.label, phase.name, std::to_string(id)});
          add_tag_numbers(row, tags);
        }
      });
    }
  }
  return table;
}

Table detection_rows(const Evaluation& evaluation, const std::string& family) {
  Table table{"",
              {"frame", "t_us", "family", "id", "hamming", "margin", "cx", "cy", "x1", "y1", "x2", "y2", "x3",
               "y3", "x4", "y4", "input", "method"},
              {}};
  for (const InputRun& input : evaluation.inputs) {
    for (const MethodRun& run : input.methods) {
      for (const FrameDetections& frame : run.frames) {
        for (const Detection& tag : frame.detections) {
          Row& row = table.rows.emplace_back(detection_row(frame, tag, family));
          row.push_back(input.input.path.string());
          row.push_back(run.label);
        }
      }
    }
  }
  return table;
}

Table frame_rows(const Evaluation& evaluation, const std::vector<InputResult>& results) {
  Table table{"", {"input", "method", "frame", "t_us", "phase", "detected"}, {}};
  const std::size_t pooled = results.size() - evaluation.inputs.size();
  for (std::size_t i = 0; i < evaluation.inputs.size(); ++i) {
    const InputRun& input = evaluation.inputs[i];
    const InputResult& result = results[pooled + i];
    for (std::size_t m = 0; m < input.methods.size(); ++m) {
      std::map<std::int64_t, bool> detected;
      for (const FrameScore& frame : result.methods[m].score.frames) detected[frame.t_us] = frame.is_detected;
      for (const FrameDetections& frame : input.methods[m].frames) {
        const auto found = detected.find(frame.t_us);
        const bool is_hit = found != detected.end() && found->second;
        table.rows.push_back({result.name, input.methods[m].label, std::to_string(frame.index),
                              std::to_string(frame.t_us), phase_at(input.truth.truth.phases, frame.t_us),
                              is_hit ? "1" : "0"});
      }
    }
  }
  return table;
}

Table quality_table(const InputResult& result) {
  Table table{"Against clean frames",
              {"method", "phase", "frames", "SSIM", "SSIM, fitted", "PSNR, dB", "sharpness"},
              {}};
  for (const MethodResult& method : result.methods) {
    for (const QualitySummary& row : method.quality) {
      table.rows.push_back({method.label, row.phase, std::to_string(row.frames), decimal_text(row.ssim, 3),
                            decimal_text(row.ssim_fitted, 3), decimal_text(row.psnr_db, 2),
                            decimal_text(row.sharpness, 2)});
    }
  }
  return table;
}

Table tracking_table(const InputResult& result) {
  Table table{"Tracking the target",
              {"method", "phase", "available", "RMSE, m", "median, m", "largest, m", "longest gap, s"},
              {}};
  for (const MethodResult& method : result.methods) {
    if (!method.tracking) continue;
    const auto add = [&](const PhaseTracking& phase) {
      table.rows.push_back({method.label, phase.name, share_text(phase.available),
                            decimal_text(phase.rmse_m, 3), decimal_text(phase.error_median_m, 3),
                            decimal_text(phase.error_max_m, 3),
                            fmt::format("{:.2f}", static_cast<double>(phase.longest_gap_us) * 1e-6)});
    };
    for (const PhaseTracking& phase : method.tracking->phases) add(phase);
    add(method.tracking->total);
  }
  return table;
}

}  // namespace esi
