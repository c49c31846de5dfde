#pragma once

#include <nlohmann/json_fwd.hpp>

#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

/// All that a sweep found, for table.json. What there is no number for is null.
nlohmann::json to_json(const SweepOutcome& outcome);

}  // namespace esi
