#include "esi/pipeline/evaluation/pooling.hpp"

#include <algorithm>
#include <optional>

namespace esi {
namespace {

/// Between inputs; of the corners before and after an input's phases, less than half of it is kept, so that
/// they stay apart. Longer than any gap that is interpolated over.
constexpr std::int64_t kPause_us = 10'000'000;
constexpr std::int64_t kMargin_us = 1'000'000;

const MethodRun* run_of(const InputRun& input, const std::string& label) {
  const auto found = std::find_if(input.methods.begin(), input.methods.end(),
                                  [&](const MethodRun& run) { return run.label == label; });
  return found == input.methods.end() ? nullptr : &*found;
}

/// Several inputs on one clock.
struct Timeline {
  std::vector<Phase> phases;
  std::vector<TrueCorners> corners;
  std::vector<FrameDetections> frames;
  bool has_corners = true;
  std::int64_t frames_outside = 0;  ///< before an input's first phase or after its last
  std::int64_t end_us = 0;

  void append(const InputRun& input, const MethodRun& run) {
    const auto& own_phases = input.truth.truth.phases;
    const Interval whole{own_phases.front().interval.begin_us, own_phases.back().interval.end_us};
    const std::int64_t by_us = end_us - whole.begin_us;
    for (Phase phase : own_phases) {
      phase.interval = {phase.interval.begin_us + by_us, phase.interval.end_us + by_us};
      phases.push_back(std::move(phase));
    }
    for (FrameDetections frame : run.frames) {
      const bool is_inside = whole.contains(frame.t_us);
      frames_outside += is_inside ? 0 : 1;
      frame.t_us += by_us;
      if (is_inside) frames.push_back(std::move(frame));
    }
    for (TrueCorners row : input.truth.corner_rows) {
      if (row.t_us < whole.begin_us - kMargin_us || row.t_us >= whole.end_us + kMargin_us) continue;
      row.t_us += by_us;
      corners.push_back(row);
    }
    has_corners = has_corners && input.truth.corners;
    end_us = phases.back().interval.end_us + kPause_us;
  }
};

bool expect_the_same(const std::vector<InputRun>& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [&](const InputRun& input) {
    return input.truth.expected.ids == inputs.front().truth.expected.ids &&
           input.truth.corners.has_value() == inputs.front().truth.corners.has_value();
  });
}

Score pooled(const Timeline& timeline, const ExpectedTags& expected, const ScoreOptions& options) {
  std::optional<CornerTrack> track;
  if (timeline.has_corners) track.emplace(timeline.corners);
  const CornerTrack* const corners = track ? &*track : nullptr;
  Score whole = score(timeline.phases, expected, corners, timeline.frames, options);
  whole.frames_outside += timeline.frames_outside;
  std::vector<std::string> names;
  for (const Phase& phase : timeline.phases) {
    if (std::find(names.begin(), names.end(), phase.name) == names.end()) names.push_back(phase.name);
  }
  whole.phases.clear();
  for (const std::string& name : names) {
    std::vector<Phase> of_name;
    std::copy_if(timeline.phases.begin(), timeline.phases.end(), std::back_inserter(of_name),
                 [&](const Phase& phase) { return phase.name == name; });
    whole.phases.push_back(score(of_name, expected, corners, timeline.frames, options).total);
    whole.phases.back().name = name;
  }
  return whole;
}

}  // namespace

std::vector<std::pair<std::string, Score>> pooled_scores(const std::vector<InputRun>& inputs,
                                                         const ScoreOptions& options) {
  std::vector<std::pair<std::string, Score>> scores;
  if (inputs.size() < 2 || !expect_the_same(inputs)) return scores;
  for (const MethodRun& first : inputs.front().methods) {
    Timeline timeline;
    bool is_everywhere = true;
    for (const InputRun& input : inputs) {
      const MethodRun* const run = run_of(input, first.label);
      is_everywhere = is_everywhere && run != nullptr;
      if (run != nullptr) timeline.append(input, *run);
    }
    if (is_everywhere)
      scores.emplace_back(first.label, pooled(timeline, inputs.front().truth.expected, options));
  }
  return scores;
}

}  // namespace esi
