#include "esi/eval/score.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/eval/phase_tally.hpp"

namespace esi {
namespace {

/// The phase that has this time, or their number.
std::size_t phase_at(std::span<const Phase> phases, std::int64_t t_us) {
  const auto has_time = [&](const Phase& phase) { return phase.interval.contains(t_us); };
  return static_cast<std::size_t>(std::find_if(phases.begin(), phases.end(), has_time) - phases.begin());
}

void require_ascending(std::span<const FrameDetections> frames) {
  const auto clash =
      std::adjacent_find(frames.begin(), frames.end(),
                         [](const FrameDetections& a, const FrameDetections& b) { return b.t_us <= a.t_us; });
  if (clash == frames.end()) return;
  throw usage_error(fmt::format("frame {} at {} s is not after frame {} at {} s; frames must ascend in time",
                                (clash + 1)->index, seconds_text((clash + 1)->t_us), clash->index,
                                seconds_text(clash->t_us)));
}

std::vector<TagChance> chances_in(const FrameDetections& frame, const FrameVerdict& verdict,
                                  const ExpectedTags& expected, const CornerTrack* corners) {
  std::vector<TagChance> chances;
  for (const int id : expected.ids) {
    if (corners != nullptr) {
      const auto place = corners->at(id, frame.t_us);
      if (!place || !place->visible) continue;
    }
    const auto is_it = [id](const TagHit& hit) { return hit.detection.id == id; };
    chances.push_back({id, std::any_of(verdict.hits.begin(), verdict.hits.end(), is_it)});
  }
  return chances;
}

}  // namespace

void ScoreOptions::declare(OptionTable& table) {
  table.real("max_corner_error", max_corner_error_px, {0.0, 1000.0}, "px",
             "a tag counts as found where none of its corners is further from the truth");
  bootstrap.declare(table);
}

Score score(std::span<const Phase> phases, const ExpectedTags& expected, const CornerTrack* corners,
            std::span<const FrameDetections> frames, const ScoreOptions& options) {
  require_ascending(frames);
  ExpectedTags tags = expected;
  if (tags.ids.empty() && corners != nullptr) tags.ids = corners->ids();

  std::vector<std::int64_t> begins_us{0};  // of each phase on the total's clock, which stands still between
  for (const Phase& phase : phases) begins_us.push_back(begins_us.back() + phase.interval.duration_us());

  Score result;
  std::vector<PhaseTally> tallies(phases.size(), PhaseTally(tags.ids));
  PhaseTally total(tags.ids);
  for (const FrameDetections& frame : frames) {
    const std::size_t phase = phase_at(phases, frame.t_us);
    if (phase == phases.size()) {
      ++result.frames_outside;
      continue;
    }
    const FrameVerdict verdict = judge(frame, tags, corners, options.max_corner_error_px);
    const std::vector<TagChance> chances = chances_in(frame, verdict, tags, corners);
    const std::int64_t since_begin_us = frame.t_us - phases[phase].interval.begin_us;
    tallies[phase].add(since_begin_us, verdict, chances, corners != nullptr);
    total.add(begins_us[phase] + since_begin_us, verdict, chances, corners != nullptr);
    result.frames.push_back({frame.t_us, phase, !verdict.hits.empty()});
  }
  for (std::size_t i = 0; i < phases.size(); ++i) {
    result.phases.push_back(
        tallies[i].score(phases[i].name, phases[i].interval.duration_us(), options.bootstrap));
  }
  result.total = total.score("total", begins_us.back(), options.bootstrap);
  if (!result.total.reason.empty()) result.total.reason = "no frame lies in any phase";
  return result;
}

PairedDifference paired_difference(const Score& a, const Score& b, const BootstrapOptions& options) {
  std::vector<double> differences;
  std::vector<std::int64_t> times_us;
  auto other = b.frames.begin();
  for (const FrameScore& frame : a.frames) {
    while (other != b.frames.end() && other->t_us < frame.t_us) ++other;
    if (other == b.frames.end()) break;
    if (other->t_us != frame.t_us) continue;
    differences.push_back((frame.is_detected ? 1.0 : 0.0) - (other->is_detected ? 1.0 : 0.0));
    times_us.push_back(frame.t_us);
  }
  return {static_cast<std::int64_t>(differences.size()), mean(differences),
          bootstrap_mean(differences, times_us, options)};
}

}  // namespace esi
