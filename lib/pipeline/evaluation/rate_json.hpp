#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "esi/eval/statistics.hpp"

namespace esi {

/// null where there is none.
template <class Number>
nlohmann::json or_null(const std::optional<Number>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json();
}

/// [low, high], or null.
nlohmann::json interval_json(const std::optional<ConfidenceInterval>& interval);

/// {"hits", "of", "rate", "wilson95"}
nlohmann::json rate_json(const Rate& rate);

}  // namespace esi
