#pragma once

#include <string>
#include <utility>
#include <vector>

#include "esi/pipeline/evaluation/evaluate.hpp"

namespace esi::test {

/// A tag whose corners are a square of 10 px at (x_px, 20).
inline Detection tag_at(int id, double x_px) {
  Detection tag;
  tag.id = id;
  tag.margin = 100.0;
  tag.centre = {x_px + 5.0, 25.0};
  tag.xy_px = {x_px, 30, x_px + 10, 30, x_px + 10, 20, x_px, 20};
  return tag;
}

/// Frames 10 ms apart; of each the tags in it.
inline MethodRun made_run(const std::string& label, std::int64_t begin_us,
                          std::vector<std::vector<Detection>> tags) {
  MethodRun run;
  run.label = label;
  for (auto& detections : tags) {
    const auto index = static_cast<std::int64_t>(run.frames.size());
    run.frames.push_back({index, begin_us + index * 10'000, std::move(detections)});
  }
  return run;
}

inline InputRun made_input(const std::string& path, std::vector<Phase> phases, std::vector<int> ids,
                           std::vector<MethodRun> methods) {
  InputRun input;
  input.input.path = path;
  input.truth.truth.phases = std::move(phases);
  input.truth.expected.ids = std::move(ids);
  input.methods = std::move(methods);
  return input;
}

/// The tag stands at (x_px, 20) from begin to end, in rows 10 ms apart.
inline void add_corners(InputRun& input, int id, double x_px, std::int64_t begin_us, std::int64_t end_us) {
  for (std::int64_t t_us = begin_us; t_us <= end_us; t_us += 10'000) {
    input.truth.corner_rows.push_back({t_us, id, true, tag_at(id, x_px).xy_px});
  }
  input.truth.corners.emplace(input.truth.corner_rows);
}

}  // namespace esi::test
