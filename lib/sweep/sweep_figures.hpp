#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/report/svg.hpp"
#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

struct SweepFigure {
  std::string name;  ///< for a file: letters, digits, '_', '-' and '.' alone, of each figure another
  std::string caption;
  Svg svg;
};

/// For each axis with several values its curves: the rates of the slice through the best cell, of each phase
/// and of all, with their bootstrap intervals; and the best rate of all cells with that value.
std::vector<SweepFigure> curve_figures(const SweepOutcome& outcome);

/// For each two axes with several values the best rate over all other axes' values: in all phases, "tau_s-n",
/// and in each that has frames, "tau_s-n-1-straight".
std::vector<SweepFigure> heat_map_figures(const SweepOutcome& outcome);

/// What heat maps there are not, and why: phases where there would be too many, and axes of too many values.
/// Empty where there are all.
std::string left_out_heat_maps(const SweepOutcome& outcome);

/// Other characters than letters, digits, '_', '-' and '.' as '-', at most 40.
std::string figure_name(std::string_view text);

/// "tau_s (s)"
std::string axis_label(const SweepAxis& axis);

}  // namespace esi
