#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "esi/recon/flow/esi_flow.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// The options of one of esi-flow's configs, by its name.
inline EsiFlowOptions flow_options_of(const std::string& config) {
  EsiFlowOptions options;
  const auto path = source_dir() / "configs" / "recon" / (config + ".json");
  table_of(options).set_json(nlohmann::json::parse(content_of(path.string()))["set"]);
  return options;
}

}  // namespace esi::test
