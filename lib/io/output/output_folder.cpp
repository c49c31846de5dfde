#include "esi/io/output/output_folder.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "esi/io/output/frame_lists.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifestName = "run.json";
constexpr const char* kIncompleteName = ".esi-incomplete";

/// The index in "frame_0000000042.png"; empty for any other name.
std::optional<std::int64_t> frame_index(const std::string& name) {
  constexpr std::string_view prefix = "frame_";
  if (!name.starts_with(prefix)) return std::nullopt;
  std::int64_t index = -1;
  std::from_chars(name.data() + prefix.size(), name.data() + name.size(), index);
  return index >= 0 && name == frame_file_name(index) ? std::optional(index) : std::nullopt;
}

bool is_ours(std::string name) {
  constexpr std::string_view part = ".part";
  if (name.ends_with(part)) name.resize(name.size() - part.size());
  return frame_index(name) || name == "timestamps.txt" || name == "images.txt" || name == "frames.csv" ||
         name == kManifestName;
}

/// Names in the folder but for the mark of the incomplete: a mark alone is of a run that wrote nothing.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  if (error) throw system_error(folder.string(), "cannot be listed", error.value());
  std::erase(names, kIncompleteName);
  return names;
}

void require_only_ours(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (is_ours(name) && !fs::is_directory(fs::symlink_status(folder / name))) continue;
    throw usage_error(fmt::format(
        "{}: holds {}, which is not part of a reconstruction; --force replaces nothing else: choose another "
        "folder",
        folder.string(), name));
  }
}

void require_resumable(const fs::path& folder, const std::string& fingerprint) {
  const std::string name = folder.string();
  if (is_there(folder / kManifestName)) {
    if (fingerprint_in(folder / kManifestName) == fingerprint) throw AlreadyComplete(name);
    throw usage_error(name +
                      ": holds a complete reconstruction of another input or with other options; --force "
                      "replaces it");
  }
  const auto found = fingerprint_in(folder / kIncompleteName);
  if (!found) {
    throw usage_error(
        fmt::format("{}: holds no run that --resume could continue (no {}); --force replaces a "
                    "reconstruction that is there",
                    name, kIncompleteName));
  }
  if (*found != fingerprint) {
    throw usage_error(name +
                      ": the interrupted run there had another input or other options; give the same, or "
                      "--force to replace it");
  }
}

void require_usable(const fs::path& folder, const std::vector<std::string>& names, const SinkOptions& options,
                    const std::string& fingerprint) {
  if (names.empty()) return;
  if (options.force) return require_only_ours(folder, names);
  if (options.resume) return require_resumable(folder, fingerprint);
  throw usage_error(
      fmt::format("{}: is not empty; choose another folder, --force to replace a reconstruction that "
                  "is there, or --resume to continue one that was interrupted",
                  folder.string()));
}

/// Looks before anything is written; makes the folder.
fs::path usable_folder(fs::path folder, const SinkOptions& options, const std::string& fingerprint) {
  if (options.force && options.resume) throw usage_error("--force and --resume exclude each other");
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::is_directory(status)) {
    require_usable(folder, names_in(folder), options, fingerprint);
  } else if (fs::exists(status)) {
    throw usage_error(folder.string() + ": is a file, where a folder is to be written");
  } else if (fs::create_directories(folder, error); error) {
    throw system_error(folder.string(), "cannot be created", error.value());
  }
  return folder;
}

}  // namespace

std::optional<std::string> fingerprint_in(const fs::path& json_file) {
  if (!is_there(json_file)) return std::nullopt;
  const auto json = nlohmann::json::parse(read_text_file(json_file), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto found = json.find("fingerprint");
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

OutputFolder::OutputFolder(fs::path path, const SinkOptions& options, const std::string& fingerprint)
    : path_(usable_folder(std::move(path), options, fingerprint)),
      incomplete_(path_ / kIncompleteName, path_.string()) {
  // Another run may have come and gone before the lock was taken.
  const std::vector<std::string> names = names_in(path_);
  require_usable(path_, names, options, fingerprint);
  incomplete_.keep_at_end();
  is_resumed_ = options.resume && !names.empty();
  if (is_resumed_) return;
  // Until the old frames are gone the mark is empty: they must never be taken for this run's.
  incomplete_.replace_content("");
  remove_file(path_ / kManifestName);
  for (const std::string& name : names) remove_file(path_ / name);
  incomplete_.replace_content(nlohmann::json{{"fingerprint", fingerprint}}.dump() + '\n');
}

fs::path OutputFolder::frame_path(std::int64_t index) const { return path_ / frame_file_name(index); }

void OutputFolder::remove_frames(std::int64_t begin) const {
  for (const std::string& name : names_in(path_)) {
    if (frame_index(name).value_or(-1) >= begin) remove_file(path_ / name);
  }
}

void OutputFolder::complete(const std::string& manifest) {
  write_file(path_ / kManifestName, manifest);
  incomplete_.remove();
}

}  // namespace esi
