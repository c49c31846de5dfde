#pragma once

#include <string>
#include <vector>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

/// What each parameter does to the rate that decides, a few sentences for each axis with several values:
/// whether it matters, where, by how many points, and how sure that is. All from the best cell with that
/// value changed, compared on the same frames; and whether other parameters can make up for it.
std::vector<std::string> main_effects(const SweepOutcome& outcome);

}  // namespace esi
