#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/pipeline/stopwatch.hpp"
#include "esi/sweep/sweep_header.hpp"
#include "esi/sweep/sweep_job.hpp"
#include "esi/sweep/sweep_search.hpp"

namespace esi {
namespace {

constexpr double kSample_s = 2.0;

/// The middle of the longest phase.
Interval sample_of(const SweptRecording& recording, const EventDigest& events) {
  const auto longest = std::max_element(
      recording.phases.begin(), recording.phases.end(),
      [](const Phase& a, const Phase& b) { return a.interval.duration_us() < b.interval.duration_us(); });
  const Interval whole{std::max(longest->interval.begin_us, *events.t_first_us()),
                       std::min(longest->interval.end_us, *events.t_last_us() + 1)};
  if (whole.is_empty()) return {*events.t_first_us(), *events.t_last_us() + 1};
  const std::int64_t half_us = std::min(us_from_seconds(kSample_s), whole.duration_us()) / 2;
  const std::int64_t middle_us = whole.begin_us + whole.duration_us() / 2;
  return {middle_us - half_us, middle_us + half_us};
}

/// Of one cell, for a second of the recording.
double measured_s(const SweepConfig& config, const InputRun& run, const SweptRecording& recording) {
  const Interval sample = sample_of(recording, *run.digest);
  const auto evaluation_s = [&](const std::vector<std::size_t>& cells) {
    EvalConfig eval = config.eval_config(config.grid(), cells);
    eval.frames.start_s = static_cast<double>(sample.begin_us) * 1e-6;
    eval.frames.end_s = static_cast<double>(sample.end_us) * 1e-6;
    eval.frames.duration_s.reset();
    InputRun input;
    input.input = run.input;
    input.truth = run.truth;
    const Stopwatch watch;
    evaluate(eval, {std::move(input)}, 1, {});
    return watch.seconds();
  };
  const double decode_s = evaluation_s({});  // up to the sample, which has nothing to do with cells
  return std::max(0.0, evaluation_s({0}) - decode_s) / (static_cast<double>(sample.duration_us()) * 1e-6);
}

std::string time_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200.0 ? fmt::format("{:.0f} minutes", seconds / 60.0)
                          : fmt::format("{:.1f} hours", seconds / 3600.0);
}

/// Of all detections those that halving makes, where it drops no more than it must.
double share_of_halving(const SweepConfig& config, std::size_t cells) {
  const SweepSearch search(config.search, config.score.bootstrap, 1);
  double left = static_cast<double>(cells), share = 0.0;
  for (std::int64_t round = 0; round < search.rounds(); ++round) {
    share += left / static_cast<double>(search.frames(round).stride);
    left = std::ceil(left / 2.0);
  }
  return share / static_cast<double>(cells);
}

std::string axes_text(const SweepGrid& grid) {
  std::string text;
  for (const SweepAxis& axis : grid.axes()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " x ", axis.values.size(), axis.option);
  }
  return text.empty() ? "no axis" : text;
}

}  // namespace

std::string plan_text(const SweepConfig& config, int threads) {
  config.check();
  std::vector<InputRun> runs;
  const Stopwatch watch;
  const SweepHeader header = survey(config, runs, {});
  const double survey_s = watch.seconds();
  double duration_s = 0.0;
  for (const SweptRecording& recording : header.recordings) duration_s += recording.duration_s;
  const SweepGrid grid = config.grid();
  const double cell_s = measured_s(config, runs.front(), header.recordings.front());
  const double work_s = cell_s * duration_s * static_cast<double>(grid.cells());
  std::string text = fmt::format("cells: {} ({})\nrecordings: {}, {:.1f} s in all\n", grid.cells(),
                                 axes_text(grid), header.recordings.size(), duration_s);
  text += fmt::format("time: about {} with {} thread{}: a cell takes {:.2g} s for a second of {}\n",
                      time_text(work_s / threads + survey_s), threads, threads == 1 ? "" : "s", cell_s,
                      header.recordings.front().path);
  if (config.search.search == SearchOptions::Search::halving) {
    text += fmt::format(
        "halving takes less: at least {:.1f} times fewer detections, reconstruction is not saved\n",
        1.0 / share_of_halving(config, grid.cells()));
  }
  return text;
}

}  // namespace esi
