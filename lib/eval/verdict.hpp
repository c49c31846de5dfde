#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "esi/eval/corner_track.hpp"
#include "esi/eval/detection.hpp"

namespace esi {

/// The ids that count as tags of the scene, each once. Empty: every id of the family.
struct ExpectedTags {
  std::vector<int> ids;

  bool has(int id) const;
};

/// A tag that was found where it is.
struct TagHit {
  Detection detection;
  std::optional<double> corner_error_px;  ///< mean over the four; nothing where truth has no corners
};

struct FalseDetections {
  std::int64_t foreign = 0;    ///< an id that isn't expected
  std::int64_t misplaced = 0;  ///< a corner too far from the truth
  std::int64_t duplicate = 0;  ///< one more of an id that was found

  std::int64_t total() const { return foreign + misplaced + duplicate; }
  FalseDetections& operator+=(const FalseDetections& other);
};

/// What a frame's detections are worth.
struct FrameVerdict {
  std::vector<TagHit> hits;  ///< by id, each once
  FalseDetections wrong;
};

/// Distances of the four corners from the truth in px, in the best of the four rotations.
struct CornerErrors {
  double largest_px = 0.0, mean_px = 0.0;
};
CornerErrors corner_errors(const std::array<double, 8>& found_px, const std::array<double, 8>& true_px);

/// An expected id counts where all its corners are at most `limit_px` from the truth, or where truth has no
/// corners of it at that time. `corners` may be null. Of several of one id the nearest to the truth counts,
/// without truth the one with fewest corrected bits, then the largest margin.
FrameVerdict judge(const FrameDetections& frame, const ExpectedTags& expected, const CornerTrack* corners,
                   double limit_px);

}  // namespace esi
