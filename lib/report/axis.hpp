#pragma once

#include <string>
#include <vector>

namespace esi {

/// One axis of a chart: from values to pixels.
struct Axis {
  std::string label;  ///< with its unit
  double low = 0.0, high = 1.0;
  bool is_logarithmic = false;  ///< then low > 0

  /// 0 at low, 1 at high.
  double share_of(double value) const;
};

/// An axis that holds all values, finite ones, with round ends. Logarithmic where asked and all are positive.
Axis axis_around(std::string label, const std::vector<double>& values, bool logarithmic = false);

/// Round values along the axis, about `count` of them.
std::vector<double> ticks(const Axis& axis, int count);

/// Short: "0.05", "12", "1e+06".
std::string tick_text(double value);

}  // namespace esi
