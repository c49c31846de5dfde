#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "esi/report/svg.hpp"

namespace esi {

/// A value for every pair of two parameters' values.
struct HeatMap {
  std::string x_label, y_label, value_label;
  std::vector<std::string> x, y;            ///< the parameters' values
  std::vector<std::vector<double>> values;  ///< [y][x]; NaN where there is none

  struct Place {
    std::size_t x = 0, y = 0;
  };
  std::optional<Place> outlined = {};  ///< without it the largest are
};

/// Cells in shades of blue with their values, one in bold outline.
Svg heat_map(const HeatMap& map);

}  // namespace esi
