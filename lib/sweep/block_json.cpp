#include "esi/sweep/block_json.hpp"

#include <nlohmann/json.hpp>

namespace esi {

nlohmann::json to_json(const SweepBlock& block) {
  return {{"recording", block.recording},
          {"round", block.round},
          {"stride", block.frames.stride},
          {"first", block.frames.first},
          {"cells", block.cells}};
}

SweepBlock block_from(const nlohmann::json& json) {
  SweepBlock block;
  block.recording = json.at("recording").get<std::size_t>();
  block.round = json.at("round").get<std::int64_t>();
  block.frames.stride = json.at("stride").get<std::int64_t>();
  block.frames.first = json.at("first").get<std::int64_t>();
  block.cells = json.at("cells").get<std::vector<std::size_t>>();
  return block;
}

}  // namespace esi
