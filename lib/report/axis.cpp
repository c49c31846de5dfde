#include "esi/report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace esi {
namespace {

/// 1, 2 or 5 times a power of ten, not below `step`.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * 0.999) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> linear_ticks(const Axis& axis, int count) {
  const double step = round_step((axis.high - axis.low) / count);
  std::vector<double> values;
  for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i) {
    values.push_back(i * step);
  }
  return values;
}

std::vector<double> logarithmic_ticks(const Axis& axis) {
  const bool is_short = axis.high / axis.low < 30.0;
  std::vector<double> values;
  for (double power = std::floor(std::log10(axis.low)); power <= std::log10(axis.high) + 1e-9; ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, power);
      if (value < axis.low * 0.999 || value > axis.high * 1.001) continue;
      if (factor == 1.0 || is_short) values.push_back(value);
    }
  }
  return values.size() > 1 ? values : linear_ticks(axis, 4);
}

}  // namespace

double Axis::share_of(double value) const {
  if (is_logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Axis axis_around(std::string label, const std::vector<double>& values, bool logarithmic) {
  Axis axis{std::move(label), HUGE_VAL, -HUGE_VAL, logarithmic};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    axis.low = std::min(axis.low, value);
    axis.high = std::max(axis.high, value);
  }
  if (axis.low > axis.high) axis.low = axis.high = logarithmic ? 1.0 : 0.0;
  axis.is_logarithmic = logarithmic && axis.low > 0.0;
  if (axis.is_logarithmic) {
    if (axis.low == axis.high) return axis.low /= 2.0, axis.high *= 2.0, axis;
    return axis;
  }
  if (axis.low == axis.high) return axis.low -= 0.5, axis.high += 0.5, axis;
  const double step = round_step((axis.high - axis.low) / 5.0);
  axis.low = std::floor(axis.low / step + 1e-9) * step;
  axis.high = std::ceil(axis.high / step - 1e-9) * step;
  return axis;
}

Axis axis_of_names(std::string label, std::vector<std::string> names) {
  const double last = static_cast<double>(names.size()) - 1.0;
  Axis axis{std::move(label), -0.5, std::max(last, 0.0) + 0.5, false};
  for (std::string& name : names) {
    axis.own_ticks.push_back({static_cast<double>(axis.own_ticks.size()), std::move(name)});
  }
  return axis;
}

std::vector<AxisTick> ticks(const Axis& axis, int count) {
  if (!axis.own_ticks.empty()) return axis.own_ticks;
  std::vector<AxisTick> found;
  for (const double value : axis.is_logarithmic ? logarithmic_ticks(axis) : linear_ticks(axis, count)) {
    found.push_back({value, tick_text(value)});
  }
  return found;
}

std::string tick_text(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0.0 : value); }

}  // namespace esi
