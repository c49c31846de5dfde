#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/folder_digest.hpp"
#include "support/run_tool.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

namespace esi::test {

/// Six cells on 3 s of a flight, 30 frames of each.
inline std::string small_sweep() {
  return quoted(source_dir() / "data-samples/flight/events.h5") +
         " --grid tau_s=0.5,4 --grid clamp=1,2,3 --stride 10 --quiet ";
}

inline ToolResult sweep(const std::filesystem::path& out, const std::string& arguments) {
  return run_shell(quoted(tool("esi-sweep")) + " -o " + quoted(out) + " " + arguments);
}

inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// All bytes of a complete sweep but those of run.json; the store's lines in order.
inline std::string digest_of_sweep(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "run.json")) return "incomplete";
  std::vector<std::string> lines = lines_of(folder / "cells.jsonl");
  std::sort(lines.begin(), lines.end());
  std::string digest;
  for (const std::string& line : lines) digest += line + "\n";
  for (const std::string& name : names_in(folder)) {
    if (name == "run.json" || name == "cells.jsonl") continue;
    const auto path = folder / name;
    digest += name + "\n" + (std::filesystem::is_directory(path) ? digest_of(path) : content_of(path));
  }
  return digest;
}

}  // namespace esi::test
