#pragma once

#include <string>
#include <vector>

namespace esi {

/// A place on an axis that has a text.
struct AxisTick {
  double value = 0.0;
  std::string text;
};

/// One axis of a chart: from values to pixels.
struct Axis {
  std::string label;  ///< with its unit
  double low = 0.0, high = 1.0;
  bool is_logarithmic = false;           ///< then low > 0
  std::vector<AxisTick> own_ticks = {};  ///< ascending, instead of round numbers

  /// 0 at low, 1 at high.
  double share_of(double value) const;
};

/// An axis that holds all values, finite ones, with round ends. Logarithmic where asked and all are positive.
Axis axis_around(std::string label, const std::vector<double>& values, bool logarithmic = false);

/// Names side by side, for what has no order or no even steps. The first stands at 0, the next at 1.
Axis axis_of_names(std::string label, std::vector<std::string> names);

/// Round values along the axis, about `count` of them; its own ticks where it has such.
std::vector<AxisTick> ticks(const Axis& axis, int count);

/// Short: "0.05", "12", "1e+06".
std::string tick_text(double value);

}  // namespace esi
