#pragma once

#include <string>
#include <vector>

#include "esi/core/phase.hpp"
#include "esi/report/svg.hpp"

namespace esi {

/// One row of a timeline: what came of each frame of a method.
struct TimelineRow {
  std::string name;
  std::vector<std::int64_t> t_us;  ///< of the frames, ascending
  std::vector<bool> is_hit;        ///< of the same length
};

/// Frames over time, a row a method: the share of hits in each pixel column as a grey to blue, nothing where
/// there was no frame. Phases stand above, with their borders.
Svg timeline(const std::vector<Phase>& phases, const std::vector<TimelineRow>& rows, double width_px = 900.0);

}  // namespace esi
