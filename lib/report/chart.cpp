#include "esi/report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace esi {
namespace {

constexpr double kLeft_px = 62.0, kRight_px = 16.0, kTop_px = 12.0, kBottom_px = 46.0;
constexpr double kLegendSide_px = 52.0, kLegendLeast_px = 150.0, kLegendMost_px = 300.0;
constexpr double kLine_px = 2.0;
constexpr double kBar_px = 18.0, kBarStep_px = 26.0, kBarNames_px = 170.0, kBarText_px = 90.0;
constexpr std::string_view kGrid = "#ddd", kInk = "#222";

void draw_band(Plot& plot, const Series& series, std::string_view colour) {
  std::vector<Point> outline;
  for (std::size_t i = 0; i < series.low.size(); ++i) {
    if (std::isfinite(series.low[i])) outline.push_back(plot.at(series.x[i], series.low[i]));
  }
  for (std::size_t i = series.high.size(); i-- > 0;) {
    if (std::isfinite(series.high[i])) outline.push_back(plot.at(series.x[i], series.high[i]));
  }
  if (outline.size() > 2) plot.svg().polygon(outline, colour, 0.18);
}

void draw_line(Plot& plot, const Series& series, std::string_view colour) {
  std::vector<Point> points;
  const auto end_part = [&] {
    if (points.size() > 1) plot.svg().polyline(points, colour, kLine_px, series.is_dashed);
    points.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.y[i])) {
      end_part();
      continue;
    }
    points.push_back(plot.at(series.x[i], series.y[i]));
    if (series.has_marks) plot.svg().circle(points.back(), 3.0, colour);
  }
  end_part();
}

double legend_width_px(const std::vector<Series>& series) {
  if (series.size() < 2) return 0.0;
  double longest_px = 0.0;
  for (const Series& one : series) longest_px = std::max(longest_px, text_width_px(one.name));
  return std::clamp(longest_px + kLegendSide_px, kLegendLeast_px, kLegendMost_px);
}

void draw_legend(Plot& plot, const std::vector<Series>& series) {
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double y_px = kTop_px + 8.0 + 18.0 * static_cast<double>(i);
    const double x_px = plot.right_px() + 12.0;
    plot.svg().polyline({{x_px, y_px}, {x_px + 18.0, y_px}}, series_colour(i), kLine_px, series[i].is_dashed);
    plot.svg().text({x_px + 24.0, y_px + 4.0}, series[i].name);
  }
}

}  // namespace

Plot::Plot(Axis x, Axis y, double width_px, double height_px, double legend_px)
    : x_(std::move(x)),
      y_(std::move(y)),
      left_px_(kLeft_px),
      right_px_(width_px - kRight_px - legend_px),
      top_px_(kTop_px),
      bottom_px_(height_px - kBottom_px),
      svg_(width_px, height_px) {
  draw_axes();
}

Point Plot::at(double x, double y) const {
  return {left_px_ + (right_px_ - left_px_) * x_.share_of(x),
          bottom_px_ + (top_px_ - bottom_px_) * y_.share_of(y)};
}

void Plot::draw_axes() {
  for (const AxisTick& tick : ticks(x_, 8)) {
    const double x_px = at(tick.value, y_.low).x;
    svg_.line({x_px, top_px_}, {x_px, bottom_px_}, kGrid);
    svg_.text({x_px, bottom_px_ + 16.0}, tick.text, Anchor::middle);
  }
  for (const AxisTick& tick : ticks(y_, 5)) {
    const double y_px = at(x_.low, tick.value).y;
    svg_.line({left_px_, y_px}, {right_px_, y_px}, kGrid);
    svg_.text({left_px_ - 6.0, y_px + 4.0}, tick.text, Anchor::end);
  }
  svg_.line({left_px_, bottom_px_}, {right_px_, bottom_px_}, kInk);
  svg_.line({left_px_, top_px_}, {left_px_, bottom_px_}, kInk);
  svg_.text({0.5 * (left_px_ + right_px_), bottom_px_ + 36.0}, x_.label, Anchor::middle);
  svg_.upright_text({14.0, 0.5 * (top_px_ + bottom_px_)}, y_.label);
}

Svg line_chart(const Axis& x, const Axis& y, const std::vector<Series>& series, double width_px,
               double height_px) {
  Plot plot(x, y, width_px, height_px, legend_width_px(series));
  for (std::size_t i = 0; i < series.size(); ++i) {
    draw_band(plot, series[i], series_colour(i));
    draw_line(plot, series[i], series_colour(i));
  }
  if (series.size() > 1) draw_legend(plot, series);
  return std::move(plot.svg());
}

Svg bar_chart(const Axis& axis, const std::vector<Bar>& bars, double width_px) {
  Svg svg(width_px, kBarStep_px * static_cast<double>(bars.size()) + 24.0);
  const double full_px = width_px - kBarNames_px - kBarText_px;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double y_px = kBarStep_px * static_cast<double>(i) + 4.0;
    const double share = bars[i].value > 0.0 ? std::clamp(axis.share_of(bars[i].value), 0.0, 1.0) : 0.0;
    svg.text({kBarNames_px - 8.0, y_px + 13.0}, bars[i].name, Anchor::end);
    svg.rectangle({kBarNames_px, y_px}, std::max(1.0, share * full_px), kBar_px, series_colour(i));
    svg.text({kBarNames_px + std::max(1.0, share * full_px) + 6.0, y_px + 13.0}, bars[i].text);
  }
  svg.text({kBarNames_px, kBarStep_px * static_cast<double>(bars.size()) + 16.0}, axis.label);
  return svg;
}

}  // namespace esi
