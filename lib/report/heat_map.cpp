#include "esi/report/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace esi {
namespace {

constexpr double kLeast_px = 90.0, kTop_px = 26.0, kCellLeast_px = 58.0, kCellHeight_px = 28.0,
                 kFoot_px = 46.0;
/// Beside the names of rows: the axis' label.
constexpr double kNamesSide_px = 34.0;

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

double longest_px(const std::vector<std::string>& names) {
  double longest = 0.0;
  for (const std::string& name : names) longest = std::max(longest, text_width_px(name));
  return longest;
}

/// From near white to blue.
std::string shade(double share) {
  const auto mix = [share](double low, double high) { return std::lround(low + (high - low) * share); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(247, 8), mix(251, 81), mix(255, 156));
}

class HeatMapDrawing {
 public:
  explicit HeatMapDrawing(const HeatMap& map)
      : map_(map),
        extremes_(extremes_of(map)),
        left_px_(std::max(kLeast_px, longest_px(map.y) + kNamesSide_px)),
        cell_px_(std::max(kCellLeast_px, longest_px(map.x) + 8.0)),
        width_px_(cell_px_ * static_cast<double>(map.x.size())),
        height_px_(kCellHeight_px * static_cast<double>(map.y.size())),
        svg_(left_px_ + std::max({width_px_, text_width_px(map.value_label), 160.0}) + 10.0,
             kTop_px + height_px_ + kFoot_px) {}

  Svg drawn() {
    svg_.text({left_px_, 16.0}, map_.value_label);
    for (std::size_t y = 0; y < map_.y.size(); ++y) {
      svg_.text({left_px_ - 6.0, corner(0, y).y + 18.0}, map_.y[y], Anchor::end);
      for (std::size_t x = 0; x < map_.x.size(); ++x) draw_cell(x, y);
    }
    const double bottom_px = kTop_px + height_px_;
    for (std::size_t x = 0; x < map_.x.size(); ++x) {
      svg_.text({corner(x, 0).x + 0.5 * cell_px_, bottom_px + 16.0}, map_.x[x], Anchor::middle);
    }
    svg_.text({left_px_ + 0.5 * width_px_, bottom_px + 36.0}, map_.x_label, Anchor::middle);
    svg_.upright_text({14.0, kTop_px + 0.5 * height_px_}, map_.y_label);
    return std::move(svg_);
  }

 private:
  Point corner(std::size_t x, std::size_t y) const {
    return {left_px_ + cell_px_ * static_cast<double>(x), kTop_px + kCellHeight_px * static_cast<double>(y)};
  }

  bool is_outlined(std::size_t x, std::size_t y) const {
    if (map_.outlined) return map_.outlined->x == x && map_.outlined->y == y;
    return map_.values[y][x] == extremes_.high;
  }

  void draw_cell(std::size_t x, std::size_t y) {
    const double value = map_.values[y][x];
    const Point at = corner(x, y), middle{at.x + 0.5 * cell_px_, at.y + 18.0};
    if (is_outlined(x, y)) svg_.rectangle(at, cell_px_, kCellHeight_px, "#d55e00");
    if (!std::isfinite(value)) return svg_.text(middle, "-", Anchor::middle);
    const double range = extremes_.high - extremes_.low;
    const double share = range > 0.0 ? (value - extremes_.low) / range : 0.5;
    svg_.rectangle({at.x + 2.0, at.y + 2.0}, cell_px_ - 4.0, kCellHeight_px - 4.0, shade(share));
    svg_.text(middle, fmt::format("{:.3g}", value), Anchor::middle, share > 0.5 ? "#fff" : "#222");
  }

  const HeatMap& map_;
  Extremes extremes_;
  double left_px_, cell_px_, width_px_, height_px_;
  Svg svg_;
};

}  // namespace

Svg heat_map(const HeatMap& map) { return HeatMapDrawing(map).drawn(); }

}  // namespace esi
