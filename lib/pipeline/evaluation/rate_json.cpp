#include "esi/pipeline/evaluation/rate_json.hpp"

namespace esi {

nlohmann::json interval_json(const std::optional<ConfidenceInterval>& interval) {
  return interval ? nlohmann::json::array({interval->low, interval->high}) : nlohmann::json();
}

nlohmann::json rate_json(const Rate& rate) {
  return {{"hits", rate.hits},
          {"of", rate.of},
          {"rate", or_null(rate.value())},
          {"wilson95", interval_json(rate.wilson())}};
}

}  // namespace esi
