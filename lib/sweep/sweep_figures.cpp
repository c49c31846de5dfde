#include "esi/sweep/sweep_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "esi/report/chart.hpp"
#include "esi/sweep/cell_ranking.hpp"
#include "esi/sweep/value_effects.hpp"

namespace esi {
namespace {

/// From here on values are so far apart that only a logarithmic axis shows them all.
constexpr double kLogarithmicSpan = 20.0;
/// Texts closer together would cover each other: a share of the axis.
constexpr double kLeastTickShare = 0.08;
constexpr double kWidth_px = 780.0, kHeight_px = 320.0, kLegendLine_px = 18.0;
constexpr std::size_t kLongestName = 32;

/// What fits beside a figure. Never cuts within a character of UTF-8.
std::string shortened(const std::string& name) {
  std::size_t characters = 0, byte = 0;
  for (; byte < name.size(); ++byte) {
    const bool is_start = (static_cast<unsigned char>(name[byte]) & 0xc0U) != 0x80U;
    if (is_start && characters++ == kLongestName) return name.substr(0, byte) + "...";
  }
  return name;
}

double percent(const std::optional<double>& share) { return share ? 100.0 * *share : NAN; }

std::string curve_caption(const SweepOutcome& outcome, const SweepAxis& axis) {
  return fmt::format(
      "{}: the best cell with this parameter changed and all others as they are. Lines are the share of "
      "frames with a tag found, bands its 95 % intervals by the block bootstrap. Best with this value: the "
      "highest rate in {} of all cells with the value, whatever their other values.",
      axis.option, outcome.objective);
}

/// The curves over one axis.
class CurvePlot {
 public:
  CurvePlot(const SweepOutcome& outcome, std::size_t axis)
      : outcome_(outcome),
        number_(axis),
        axis_(outcome.grid.axes()[axis]),
        order_(ascending_values(axis_)),
        slice_(slice_through_best(outcome, axis)) {}

  Svg drawn() {
    const std::size_t total = outcome_.phases.size();
    for (std::size_t phase = 0; phase < total && total > 1; ++phase) add(slice_series(phase));
    add(slice_series(total));
    add(best_series(objective_phase(outcome_)));
    std::vector<double> values;
    for (const Series& series : series_) {
      for (const auto* part : {&series.y, &series.low, &series.high}) {
        values.insert(values.end(), part->begin(), part->end());
      }
    }
    const double height_px =
        std::max(kHeight_px, kLegendLine_px * static_cast<double>(series_.size()) + 40.0);
    return line_chart(x_axis(), axis_around("rate, %", values), series_, kWidth_px, height_px);
  }

 private:
  double x_of(std::size_t value, std::size_t place) const {
    return axis_.numbers.empty() ? static_cast<double>(place) : axis_.numbers[value];
  }

  Series slice_series(std::size_t phase) const {
    Series series{shortened(phase_name(outcome_, phase)), {}, {}, {}, {}, true, false};
    for (std::size_t place = 0; place < order_.size(); ++place) {
      const ShownRate shown = shown_rate(outcome_, outcome_.cells[slice_[order_[place]]], phase);
      series.x.push_back(x_of(order_[place], place));
      series.y.push_back(percent(shown.rate));
      series.low.push_back(shown.bootstrap ? 100.0 * shown.bootstrap->low : NAN);
      series.high.push_back(shown.bootstrap ? 100.0 * shown.bootstrap->high : NAN);
    }
    return series;
  }

  Series best_series(std::size_t phase) const {
    std::vector<HighestRate> highest(axis_.values.size());
    for (const CellOutcome& cell : outcome_.cells) {
      highest[outcome_.grid.position(cell.cell)[number_]].add(cell, shown_rate(outcome_, cell, phase));
    }
    Series series{"best with this value", {}, {}, {}, {}, false, true};
    for (std::size_t place = 0; place < order_.size(); ++place) {
      series.x.push_back(x_of(order_[place], place));
      series.y.push_back(percent(highest[order_[place]].value()));
    }
    return series;
  }

  void add(Series series) {
    const auto is_number = [](double value) { return std::isfinite(value); };
    if (std::any_of(series.y.begin(), series.y.end(), is_number)) series_.push_back(std::move(series));
  }

  Axis x_axis() const {
    if (axis_.numbers.empty()) {
      std::vector<std::string> names;
      for (const std::string& value : axis_.values) names.push_back(shortened(value));
      return axis_of_names(axis_label(axis_), names);
    }
    const double low = axis_.numbers[order_.front()], high = axis_.numbers[order_.back()];
    const bool is_wide = low > 0.0 && high > kLogarithmicSpan * low;
    Axis axis = axis_around(axis_label(axis_), axis_.numbers, axis_.is_logarithmic || is_wide);
    double last_share = -1.0;
    for (const std::size_t value : order_) {
      const double share = axis.share_of(axis_.numbers[value]);
      if (share - last_share < kLeastTickShare) continue;
      axis.own_ticks.push_back({axis_.numbers[value], axis_.values[value]});
      last_share = share;
    }
    return axis;
  }

  const SweepOutcome& outcome_;
  std::size_t number_;
  const SweepAxis& axis_;
  std::vector<std::size_t> order_, slice_;
  std::vector<Series> series_;
};

}  // namespace

std::string figure_name(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string name(text.substr(0, kLongest));
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!is_letter && !(c >= '0' && c <= '9') && c != '_' && c != '.') c = '-';
  }
  return name;
}

std::string axis_label(const SweepAxis& axis) {
  return axis.unit.empty() ? axis.option : axis.option + " (" + axis.unit + ")";
}

std::vector<SweepFigure> curve_figures(const SweepOutcome& outcome) {
  std::vector<SweepFigure> figures;
  for (std::size_t i = 0; i < outcome.grid.axes().size(); ++i) {
    const SweepAxis& axis = outcome.grid.axes()[i];
    if (axis.values.size() < 2) continue;
    figures.push_back(
        {figure_name(axis.option), curve_caption(outcome, axis), CurvePlot(outcome, i).drawn()});
  }
  return figures;
}

}  // namespace esi
