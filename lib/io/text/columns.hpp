#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/io/read_options.hpp"
#include "esi/io/text/line.hpp"

namespace esi {

/// What one column of some lines holds.
struct ColumnStatistics {
  std::int64_t numbers = 0;
  std::int64_t points = 0;       ///< written with a decimal point or an exponent
  std::int64_t coordinates = 0;  ///< whole, and at most 65535 to either side of 0
  std::int64_t rises = 0, falls = 0;
  std::int64_t values[4] = {};  ///< how many are -1, 0, 1, 2
  double previous = 0;

  void add(std::string_view number);

  /// The code that most of the values fit, and how many do. automatic where all of them are 1.
  PolarityCode polarity() const;
  std::int64_t in_code(PolarityCode code) const;

  bool holds_polarity() const;
  bool holds_coordinates() const { return coordinates * 10 >= numbers * 9; }
  /// As times do, jitter aside.
  bool is_sorted() const { return falls * 100 <= numbers; }
  bool is_disordered() const { return falls > 2 && falls * 4 > numbers; }
};

/// Statistics of `columns` columns over those lines that have that many, all of them numbers but for columns
/// that `is_ignored` marks.
std::vector<ColumnStatistics> column_statistics(std::string_view lines, char separator,
                                                std::span<const bool> is_ignored);

/// "txyp" or "xypt", whichever four columns plainly are. Otherwise empty, and `suggestion` is the order that
/// would fit, if there is one.
std::string detect_order(std::span<const ColumnStatistics> columns, bool is_metavision,
                         std::string& suggestion);

}  // namespace esi
