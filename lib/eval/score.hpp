#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/core/phase.hpp"
#include "esi/eval/statistics.hpp"
#include "esi/eval/verdict.hpp"

namespace esi {

struct ScoreOptions {
  double max_corner_error_px = 5.0;
  BootstrapOptions bootstrap;

  void declare(OptionTable& table);
};

/// What is known of the tags that were found, of all ids or of one.
struct TagScore {
  /// Of the expected tags in each frame, those found. Where truth has corners only visible tags count; where
  /// every id of the family is expected there is no base, `of` is 0.
  Rate instances;
  std::optional<double> corner_error_median_px, corner_error_mean_px, corner_error_p95_px;
  std::optional<double> margin_median;         ///< grey levels
  std::vector<std::int64_t> hamming;           ///< [b]: found tags of which b bits were corrected
  std::int64_t unverified = 0;                 ///< found tags for which truth has no corners at that time
  std::optional<std::int64_t> first_found_us;  ///< since the phase's begin
  std::int64_t longest_gap_us = 0;             ///< in the phase without a tag found; its ends count
};

struct PhaseScore {
  std::string name;
  std::int64_t duration_us = 0;
  Rate frames;                                  ///< with at least one tag found; `of` is the phase's frames
  std::string reason;                           ///< why there is no rate; empty where there is one
  std::optional<ConfidenceInterval> bootstrap;  ///< of the rate of frames; nothing in phases of < 2 blocks
  FalseDetections wrong;
  TagScore tags;
  std::map<int, TagScore> by_id;  ///< the expected ones; where all are, those found
};

/// Whether a frame counts, for the comparison with another method's.
struct FrameScore {
  std::int64_t t_us = 0;
  std::size_t phase = 0;
  bool is_detected = false;
};

struct Score {
  std::vector<PhaseScore> phases;   ///< one for each of the truth's, in its order
  PhaseScore total;                 ///< of all phases; what lies between phases takes no time in it
  std::int64_t frames_outside = 0;  ///< in no phase, and nowhere else in here
  std::vector<FrameScore> frames;   ///< those in a phase
};

/// Phases ascend and don't overlap; a frame belongs to the one whose half-open interval has its time. Times
/// of frames ascend, else a usage Error. `corners` may be null. Without expected ids, those that `corners`
/// has are expected; without both every id.
Score score(std::span<const Phase> phases, const ExpectedTags& expected, const CornerTrack* corners,
            std::span<const FrameDetections> frames, const ScoreOptions& options = {});

/// Rate of detected frames of `a` less that of `b`, over the frames that both have.
struct PairedDifference {
  std::int64_t frames = 0;
  std::optional<double> difference;
  std::optional<ConfidenceInterval> bootstrap;
};
PairedDifference paired_difference(const Score& a, const Score& b, const BootstrapOptions& options = {});

}  // namespace esi
