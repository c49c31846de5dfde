#include "esi/eval/corner_track.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {

CornerTrack::CornerTrack(std::span<const TrueCorners> rows, std::int64_t longest_gap_us)
    : longest_gap_us_(longest_gap_us) {
  for (const TrueCorners& row : rows) rows_[row.id].push_back(row);
  for (auto& [id, track] : rows_) {
    std::sort(track.begin(), track.end(),
              [](const TrueCorners& a, const TrueCorners& b) { return a.t_us < b.t_us; });
    const auto twice =
        std::adjacent_find(track.begin(), track.end(),
                           [](const TrueCorners& a, const TrueCorners& b) { return a.t_us == b.t_us; });
    if (twice == track.end()) continue;
    throw usage_error(
        fmt::format("the corners of tag {} at {} s are there twice", id, seconds_text(twice->t_us)));
  }
}

std::optional<CornerTrack::Place> CornerTrack::at(int id, std::int64_t t_us) const {
  const auto found = rows_.find(id);
  if (found == rows_.end()) return std::nullopt;
  const std::vector<TrueCorners>& track = found->second;
  const auto after = std::lower_bound(track.begin(), track.end(), t_us,
                                      [](const TrueCorners& row, std::int64_t t) { return row.t_us < t; });
  if (after == track.end()) return std::nullopt;
  if (after->t_us == t_us) return Place{after->xy_px, after->visible};
  if (after == track.begin()) return std::nullopt;
  const auto before = after - 1;
  const std::int64_t gap_us = after->t_us - before->t_us;
  if (gap_us > longest_gap_us_) return std::nullopt;
  const double share = static_cast<double>(t_us - before->t_us) / static_cast<double>(gap_us);
  Place place{{}, before->visible && after->visible};
  for (std::size_t k = 0; k < 8; ++k) {
    place.xy_px[k] = (1.0 - share) * before->xy_px[k] + share * after->xy_px[k];
  }
  return place;
}

std::vector<int> CornerTrack::ids() const {
  std::vector<int> ids;
  for (const auto& [id, track] : rows_) ids.push_back(id);
  return ids;
}

}  // namespace esi
