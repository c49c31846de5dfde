#include "esi/sweep/sweep_folder.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/sweep/sweep_files.hpp"
#include "esi/sweep/sweep_store.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

/// What a kill left of a file is called NAME.part.
std::string_view without_part(std::string_view name) {
  constexpr std::string_view kPart = ".part";
  if (name.ends_with(kPart)) name.remove_suffix(kPart.size());
  return name;
}

bool is_own(std::string_view name) {
  return name == kStoreName || name == kRunName || name == kSweepConfigName || is_sweep_file(name);
}

void refuse_foreign(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_own(without_part(name)) || (entry.is_directory() && is_sweep_folder(name))) continue;
    throw usage_error(fmt::format("{}: holds {}, which no sweep has written; choose another folder",
                                  folder.string(), name));
  }
}

}  // namespace

void prepare_sweep_folder(const fs::path& folder) {
  std::error_code error;
  if (is_there(folder) && !fs::is_directory(folder, error)) {
    throw usage_error(folder.string() + ": is a file, where a folder is to be written");
  }
  fs::create_directories(folder, error);
  if (error) throw system_error(folder.string(), "cannot be created", error.value());
  refuse_foreign(folder);
}

}  // namespace esi
