#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/run_tool.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

inline std::string sim() { return quoted(tool("esi-sim")); }

/// A camera that turns over the board for 0.2 s: some thousand events.
inline std::string tiny() {
  return " --sensor 64x48 --trajectory rotation --rotation-deg-s 200 --height-m 1 --duration 0.2"
         " --exposure-ms 20 --frame-period-ms 50 --quiet";
}

inline nlohmann::json run_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(content_of(folder / "run.json"));
}

inline ToolResult simulate(const std::filesystem::path& out, const std::string& more = {}) {
  return run_shell(sim() + tiny() + " " + more + " -o " + quoted(out));
}

}  // namespace esi::test
