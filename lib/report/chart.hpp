#pragma once

#include <string>
#include <vector>

#include "esi/report/axis.hpp"
#include "esi/report/svg.hpp"

namespace esi {

/// A line of a chart. Values that aren't finite interrupt it.
struct Series {
  std::string name;
  std::vector<double> x, y;       ///< of one length
  std::vector<double> low, high;  ///< band around y, empty or of y's length
  bool has_marks = false;         ///< a dot at each value
  bool is_dashed = false;
};

/// Lines over two axes, with a legend where there are several.
Svg line_chart(const Axis& x, const Axis& y, const std::vector<Series>& series, double width_px = 640.0,
               double height_px = 320.0);

struct Bar {
  std::string name;
  double value = 0.0;
  std::string text;  ///< beside the bar, such as the value with its unit
};

/// Horizontal bars, one below the other, from 0 on. Logarithmic lengths where the axis is.
Svg bar_chart(const Axis& axis, const std::vector<Bar>& bars, double width_px = 640.0);

/// The frame of a chart that others draw into: axes with ticks and labels.
class Plot {
 public:
  Plot(Axis x, Axis y, double width_px, double height_px, double legend_px = 0.0);

  Point at(double x, double y) const;
  Svg& svg() { return svg_; }
  double right_px() const { return right_px_; }

 private:
  void draw_axes();

  Axis x_, y_;
  double left_px_, right_px_, top_px_, bottom_px_;
  Svg svg_;
};

}  // namespace esi
