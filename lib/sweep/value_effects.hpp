#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

/// What a value of an axis makes of the best cell, on the frames of both.
struct ValueEffect {
  std::string value;             ///< with its unit: "0.5 s"
  std::optional<double> points;  ///< its rate less the best cell's, in percentage points
  std::optional<ConfidenceInterval> points95;
  std::optional<double>
      anew_points;  ///< the same of the best cell with this value, whatever its other values
  bool anew_costs = false;
  bool is_best = false;

  /// Surely worse, by a point or more.
  bool costs() const;
};

/// Differences below this are called none: percentage points.
constexpr double kLeastEffectPoints = 1.0;

/// The numbers of its values; ascending where they are numbers, else as given.
std::vector<std::size_t> ascending_values(const SweepAxis& axis);

/// For each value; ascending where they are numbers.
std::vector<ValueEffect> value_effects(const SweepOutcome& outcome, std::size_t axis);

}  // namespace esi
