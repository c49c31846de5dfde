#pragma once

#include <nlohmann/json_fwd.hpp>

#include "esi/pipeline/evaluation/results.hpp"

namespace esi {

/// All numbers of the results, for report.json. What there is no number for is null.
nlohmann::json to_json(const InputResult& result);

}  // namespace esi
