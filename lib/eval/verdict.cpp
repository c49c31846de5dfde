#include "esi/eval/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace esi {
namespace {

CornerErrors rotated_errors(const std::array<double, 8>& found_px, const std::array<double, 8>& true_px,
                            std::size_t quarter_turns) {
  CornerErrors errors;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t other = (k + quarter_turns) % 4;
    const double distance_px =
        std::hypot(found_px[2 * other] - true_px[2 * k], found_px[2 * other + 1] - true_px[2 * k + 1]);
    errors.largest_px = std::max(errors.largest_px, distance_px);
    errors.mean_px += distance_px / 4.0;
  }
  return errors;
}

struct Candidate {
  TagHit hit;
  double largest_px = 0.0;  ///< 0 without truth
};

bool is_better(const Candidate& a, const Candidate& b) {
  const auto rank = [](const Candidate& c) {
    return std::tuple(c.largest_px, c.hit.detection.hamming, -c.hit.detection.margin);
  };
  return rank(a) < rank(b);
}

/// Nothing where it is too far from the truth.
std::optional<Candidate> candidate(const Detection& detection, std::int64_t t_us, const CornerTrack* corners,
                                   double limit_px) {
  const auto place = corners != nullptr ? corners->at(detection.id, t_us) : std::nullopt;
  if (!place) return Candidate{{detection, std::nullopt}, 0.0};
  const CornerErrors errors = corner_errors(detection.xy_px, place->xy_px);
  // A corner that is NaN makes the mean NaN.
  if (!(errors.largest_px <= limit_px) || std::isnan(errors.mean_px)) return std::nullopt;
  return Candidate{{detection, errors.mean_px}, errors.largest_px};
}

}  // namespace

bool ExpectedTags::has(int id) const {
  return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
}

FalseDetections& FalseDetections::operator+=(const FalseDetections& other) {
  foreign += other.foreign;
  misplaced += other.misplaced;
  duplicate += other.duplicate;
  return *this;
}

CornerErrors corner_errors(const std::array<double, 8>& found_px, const std::array<double, 8>& true_px) {
  CornerErrors best = rotated_errors(found_px, true_px, 0);
  for (std::size_t turns = 1; turns < 4; ++turns) {
    const CornerErrors errors = rotated_errors(found_px, true_px, turns);
    if (errors.largest_px < best.largest_px) best = errors;
  }
  return best;
}

FrameVerdict judge(const FrameDetections& frame, const ExpectedTags& expected, const CornerTrack* corners,
                   double limit_px) {
  FrameVerdict verdict;
  std::map<int, Candidate> best;
  for (const Detection& detection : frame.detections) {
    if (!expected.has(detection.id)) {
      ++verdict.wrong.foreign;
      continue;
    }
    const auto found = candidate(detection, frame.t_us, corners, limit_px);
    if (!found) {
      ++verdict.wrong.misplaced;
      continue;
    }
    const auto [place, is_first] = best.try_emplace(detection.id, *found);
    if (is_first) continue;
    ++verdict.wrong.duplicate;
    if (is_better(*found, place->second)) place->second = *found;
  }
  for (const auto& [id, entry] : best) verdict.hits.push_back(entry.hit);
  return verdict;
}

}  // namespace esi
