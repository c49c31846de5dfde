#include "esi/report/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "esi/report/axis.hpp"

namespace esi {
namespace {

constexpr double kNames_px = 170.0, kRight_px = 20.0, kHead_px = 22.0, kRow_px = 18.0, kRowStep_px = 24.0,
                 kFoot_px = 40.0;
/// Narrowest.
constexpr double kColumn_px = 2.0;

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

Axis time_axis(const std::vector<Phase>& phases, const std::vector<TimelineRow>& rows) {
  double begin_s = HUGE_VAL, end_s = -HUGE_VAL;
  for (const Phase& phase : phases) {
    begin_s = std::min(begin_s, seconds(phase.interval.begin_us));
    end_s = std::max(end_s, seconds(phase.interval.end_us));
  }
  for (const TimelineRow& row : rows) {
    if (row.t_us.empty() || !phases.empty()) continue;
    begin_s = std::min(begin_s, seconds(row.t_us.front()));
    end_s = std::max(end_s, seconds(row.t_us.back()));
  }
  if (!(begin_s < end_s)) begin_s = 0.0, end_s = 1.0;
  return {"time (s)", begin_s, end_s, false};
}

/// From pale grey (no hit) to blue (all).
std::string shade(double share) {
  const auto mix = [share](double none, double all) { return std::lround(none + (all - none) * share); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(225, 0), mix(225, 114), mix(225, 178));
}

class Drawing {
 public:
  Drawing(const Axis& axis, std::size_t rows, double width_px)
      : axis_(axis),
        width_px_(width_px - kNames_px - kRight_px),
        bottom_px_(kHead_px + kRowStep_px * static_cast<double>(rows)),
        svg_(width_px, bottom_px_ + kFoot_px) {}

  void draw_row(const TimelineRow& row, double y_px) {
    // No narrower than frames are apart, so that even frames leave no gaps.
    const auto columns =
        std::clamp<std::size_t>(row.t_us.size(), 1, static_cast<std::size_t>(width_px_ / kColumn_px));
    std::vector<int> frames(columns, 0), hits(columns, 0);
    for (std::size_t i = 0; i < row.t_us.size(); ++i) {
      const double share = axis_.share_of(seconds(row.t_us[i]));
      if (share < 0.0 || share > 1.0) continue;
      const auto column =
          std::min(columns - 1, static_cast<std::size_t>(share * static_cast<double>(columns)));
      ++frames[column];
      hits[column] += row.is_hit[i] ? 1 : 0;
    }
    svg_.text({kNames_px - 8.0, y_px + 13.0}, row.name, Anchor::end);
    draw_runs(frames, hits, y_px, width_px_ / static_cast<double>(columns));
  }

  void draw_phases(const std::vector<Phase>& phases) {
    for (const Phase& phase : phases) {
      const double begin_px = x_of(seconds(phase.interval.begin_us));
      const double end_px = x_of(seconds(phase.interval.end_us));
      svg_.text({0.5 * (begin_px + end_px), 14.0}, phase.name, Anchor::middle);
      for (const double x_px : {begin_px, end_px})
        svg_.line({x_px, kHead_px - 4.0}, {x_px, bottom_px_}, "#222");
    }
  }

  void draw_axis() {
    for (const AxisTick& tick : ticks(axis_, 10)) {
      svg_.text({x_of(tick.value), bottom_px_ + 14.0}, tick.text, Anchor::middle);
    }
    svg_.text({kNames_px + 0.5 * width_px_, bottom_px_ + 32.0}, axis_.label, Anchor::middle);
  }

  Svg take() { return std::move(svg_); }

 private:
  double x_of(double t_s) const { return kNames_px + width_px_ * axis_.share_of(t_s); }

  // Columns of one shade side by side become one rectangle.
  void draw_runs(const std::vector<int>& frames, const std::vector<int>& hits, double y_px,
                 double column_px) {
    const auto shade_of = [&](std::size_t i) {
      return frames[i] == 0 ? std::string() : shade(static_cast<double>(hits[i]) / frames[i]);
    };
    for (std::size_t begin = 0; begin < frames.size();) {
      const std::string colour = shade_of(begin);
      std::size_t end = begin + 1;
      while (end < frames.size() && shade_of(end) == colour) ++end;
      if (!colour.empty()) {
        svg_.rectangle({kNames_px + column_px * static_cast<double>(begin), y_px},
                       column_px * static_cast<double>(end - begin), kRow_px, colour);
      }
      begin = end;
    }
  }

  Axis axis_;
  double width_px_;
  double bottom_px_;
  Svg svg_;
};

}  // namespace

Svg timeline(const std::vector<Phase>& phases, const std::vector<TimelineRow>& rows, double width_px) {
  Drawing drawing(time_axis(phases, rows), rows.size(), width_px);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    drawing.draw_row(rows[i], kHead_px + kRowStep_px * static_cast<double>(i) + 2.0);
  }
  drawing.draw_phases(phases);
  drawing.draw_axis();
  return drawing.take();
}

}  // namespace esi
