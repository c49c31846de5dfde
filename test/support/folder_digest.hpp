#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/temp_folder.hpp"

namespace esi::test {

/// The names in a folder, sorted.
inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// All names and bytes of a folder, and of those in it, but run.json, for comparing two folders.
inline std::string digest_of(const std::filesystem::path& folder) {
  std::string digest;
  for (const std::string& name : names_in(folder)) {
    if (name == "run.json") continue;
    const std::filesystem::path path = folder / name;
    digest += name + "\n" + (std::filesystem::is_directory(path) ? digest_of(path) : content_of(path));
  }
  return digest;
}

}  // namespace esi::test
