#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace esi::test {

/// A file of ../shared/data (or of $ESI_SHARED_DATA). Where it is absent: prints "SKIPPED: ..." for ctest to
/// see, and returns nothing.
std::optional<std::filesystem::path> shared_data(const std::string& name);

/// The project's root.
std::filesystem::path source_dir();

}  // namespace esi::test
