#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/truth.hpp"

namespace esi {

/// Where the tags' corners are at any time: linear between the rows of corners.csv.
class CornerTrack {
 public:
  struct Place {
    std::array<double, 8> xy_px{};  ///< x1, y1, ..., x4, y4; pixel centres at integers
    bool visible = false;           ///< in the row before and the row after
  };

  /// Rows in any order; those of one id must differ in time, else a usage Error. There is nothing to say
  /// between rows that are more than `longest_gap_us` apart.
  explicit CornerTrack(std::span<const TrueCorners> rows, std::int64_t longest_gap_us = 50'000);

  /// Nothing before the id's first row, after its last one, in a gap, or for an id without rows.
  std::optional<Place> at(int id, std::int64_t t_us) const;

  std::vector<int> ids() const;  ///< ascending

 private:
  std::map<int, std::vector<TrueCorners>> rows_;  // by time
  std::int64_t longest_gap_us_;
};

}  // namespace esi
