#include "support/shared_data.hpp"

#include <cstdlib>
#include <iostream>

namespace esi::test {

std::optional<std::filesystem::path> shared_data(const std::string& name) {
  const char* const folder = std::getenv("ESI_SHARED_DATA");
  const auto path = std::filesystem::path(folder != nullptr ? folder : ESI_SHARED_DATA) / name;
  if (std::filesystem::exists(path)) return path;
  std::cerr << "SKIPPED: " << path.string() << " is absent\n";
  return std::nullopt;
}

std::filesystem::path source_dir() { return ESI_SOURCE_DIR; }

}  // namespace esi::test
