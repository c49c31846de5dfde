#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "esi/eval/score.hpp"

namespace esi {

/// Collects what was found of one tag, or of all. Times are since the phase's begin.
class TagTally {
 public:
  void add_chance(bool is_found);
  void add_hit(const TagHit& hit, bool truth_has_corners);
  void add_time(std::int64_t t_us);  ///< once for each frame with a hit, ascending

  TagScore score(std::int64_t duration_us) const;

 private:
  Rate instances_;
  std::vector<double> errors_px_, margins_;
  std::vector<std::int64_t> hamming_;
  std::int64_t unverified_ = 0;
  std::optional<std::int64_t> first_us_;
  std::int64_t latest_us_ = 0, longest_gap_us_ = 0;
};

/// A tag that could have been found in a frame, and whether it was.
struct TagChance {
  int id = 0;
  bool is_found = false;
};

/// Collects a phase's frames.
class PhaseTally {
 public:
  explicit PhaseTally(const std::vector<int>& expected_ids);

  void add(std::int64_t t_us, const FrameVerdict& verdict, const std::vector<TagChance>& chances,
           bool truth_has_corners);
  PhaseScore score(std::string name, std::int64_t duration_us, const BootstrapOptions& options) const;

 private:
  std::vector<std::int64_t> times_us_;
  std::vector<double> is_detected_;
  FalseDetections wrong_;
  TagTally tags_;
  std::map<int, TagTally> by_id_;
};

}  // namespace esi
