#include "esi/report/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace esi {
namespace {

constexpr double kLeft_px = 90.0, kTop_px = 26.0, kCellWidth_px = 58.0, kCellHeight_px = 28.0,
                 kFoot_px = 46.0;

struct Extremes {
  double low = HUGE_VAL, high = -HUGE_VAL;
};

Extremes extremes_of(const HeatMap& map) {
  Extremes found;
  for (const auto& row : map.values) {
    for (const double value : row) {
      if (!std::isfinite(value)) continue;
      found.low = std::min(found.low, value);
      found.high = std::max(found.high, value);
    }
  }
  return found;
}

/// From near white to blue.
std::string shade(double share) {
  const auto mix = [share](double low, double high) { return std::lround(low + (high - low) * share); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(247, 8), mix(251, 81), mix(255, 156));
}

void draw_cell(Svg& svg, Point corner, double value, const Extremes& extremes) {
  if (!std::isfinite(value)) return svg.text({corner.x + 22.0, corner.y + 18.0}, "-");
  const double range = extremes.high - extremes.low;
  const double share = range > 0.0 ? (value - extremes.low) / range : 0.5;
  if (value == extremes.high) svg.rectangle(corner, kCellWidth_px, kCellHeight_px, "#d55e00");
  svg.rectangle({corner.x + 2.0, corner.y + 2.0}, kCellWidth_px - 4.0, kCellHeight_px - 4.0, shade(share));
  svg.text({corner.x + 0.5 * kCellWidth_px, corner.y + 18.0}, fmt::format("{:.3g}", value), Anchor::middle,
           share > 0.5 ? "#fff" : "#222");
}

}  // namespace

Svg heat_map(const HeatMap& map) {
  const double width_px = kCellWidth_px * static_cast<double>(map.x.size());
  const double height_px = kCellHeight_px * static_cast<double>(map.y.size());
  Svg svg(std::max(kLeft_px + width_px + 10.0, 260.0), kTop_px + height_px + kFoot_px);
  const Extremes extremes = extremes_of(map);
  svg.text({kLeft_px, 16.0}, map.value_label);
  for (std::size_t row = 0; row < map.y.size(); ++row) {
    const double y_px = kTop_px + kCellHeight_px * static_cast<double>(row);
    svg.text({kLeft_px - 6.0, y_px + 18.0}, map.y[row], Anchor::end);
    for (std::size_t column = 0; column < map.x.size(); ++column) {
      const double x_px = kLeft_px + kCellWidth_px * static_cast<double>(column);
      draw_cell(svg, {x_px, y_px}, map.values[row][column], extremes);
    }
  }
  for (std::size_t column = 0; column < map.x.size(); ++column) {
    const double x_px = kLeft_px + kCellWidth_px * (static_cast<double>(column) + 0.5);
    svg.text({x_px, kTop_px + height_px + 16.0}, map.x[column], Anchor::middle);
  }
  svg.text({kLeft_px + 0.5 * width_px, kTop_px + height_px + 36.0}, map.x_label, Anchor::middle);
  svg.upright_text({14.0, kTop_px + 0.5 * height_px}, map.y_label);
  return svg;
}

}  // namespace esi
