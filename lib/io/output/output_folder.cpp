#include "esi/io/output/output_folder.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
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

constexpr bool has_no_folder(std::string_view /*name*/) { return false; }

bool is_of_reconstruction(std::string_view name) {
  return frame_index(std::string(name)) || name == "timestamps.txt" || name == "images.txt" ||
         name == "frames.csv" || name == kManifestName;
}

/// As it will be called once it is whole.
std::string_view final_name(std::string_view name) {
  constexpr std::string_view part = ".part";
  return name.ends_with(part) ? name.substr(0, name.size() - part.size()) : name;
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

/// The first thing in a folder that is no numbered picture or list of them; empty where there is none.
std::string stranger_among_pictures(const fs::path& folder) {
  for (const std::string& name : names_in(folder)) {
    const std::string_view whole = final_name(name);
    const bool is_ours = is_picture_name(whole) || whole == "images.txt";
    if (!is_ours || fs::is_directory(fs::symlink_status(folder / name))) return name;
  }
  return {};
}

/// The same for a run's folder.
std::string stranger_in(const fs::path& folder, const std::vector<std::string>& names,
                        const FolderContent& content) {
  for (const std::string& name : names) {
    const std::string_view whole = final_name(name);
    if (!fs::is_directory(fs::symlink_status(folder / name))) {
      if (!content.has_file(whole)) return name;
    } else if (!content.has_folder(whole)) {
      return name;
    } else if (const std::string inner = stranger_among_pictures(folder / name); !inner.empty()) {
      return fmt::format("{}/{}", name, inner);
    }
  }
  return {};
}

void require_only_ours(const fs::path& folder, const std::vector<std::string>& names,
                       const FolderContent& content) {
  const std::string stranger = stranger_in(folder, names, content);
  if (stranger.empty()) return;
  throw usage_error(
      fmt::format("{}: holds {}, which is not part of {}; --force replaces nothing else: choose another "
                  "folder",
                  folder.string(), stranger, content.what));
}

/// A file, or a folder in which there are only pictures of ours.
void remove_content(const fs::path& path) {
  if (!fs::is_directory(fs::symlink_status(path))) return remove_file(path);
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw system_error(path.string(), "cannot be removed", error.value());
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
                    const std::string& fingerprint, const FolderContent& content) {
  if (names.empty()) return;
  if (options.force) return require_only_ours(folder, names, content);
  if (options.resume) return require_resumable(folder, fingerprint);
  throw usage_error(
      fmt::format("{}: is not empty; choose another folder, {}--force to replace {} that is there{}",
                  folder.string(), content.can_be_resumed ? "" : "or ", content.what,
                  content.can_be_resumed ? ", or --resume to continue one that was interrupted" : ""));
}

/// The folder, or the nearest of those that lead to it that is there.
fs::path nearest_there(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (there.has_relative_path() && !fs::exists(there, error)) there = there.parent_path();
  return there;
}

/// Looks before anything is written; makes the folder.
fs::path usable_folder(fs::path folder, const SinkOptions& options, const std::string& fingerprint,
                       const FolderContent& content) {
  if (options.force && options.resume) throw usage_error("--force and --resume exclude each other");
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::is_directory(status)) {
    require_usable(folder, names_in(folder), options, fingerprint, content);
  } else if (fs::exists(status)) {
    throw usage_error(folder.string() + ": is a file, where a folder is to be written");
  } else if (fs::create_directories(folder, error); error) {
    throw system_error(folder.string(), "cannot be created", error.value());
  }
  return folder;
}

}  // namespace

const FolderContent kReconstructionContent{"a reconstruction", is_of_reconstruction, has_no_folder, true};

bool is_picture_name(std::string_view name) {
  constexpr std::string_view prefix = "frame_", suffix = ".png";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  name.remove_prefix(prefix.size());
  name.remove_suffix(std::min(suffix.size(), name.size()));
  return !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
}

std::optional<std::string> fingerprint_in(const fs::path& json_file) {
  if (!is_there(json_file)) return std::nullopt;
  const auto json = nlohmann::json::parse(read_text_file(json_file), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto found = json.find("fingerprint");
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

void require_usable_folder(const fs::path& path, const SinkOptions& options, const FolderContent& content) {
  const fs::path there = nearest_there(path);
  std::error_code error;
  if (!fs::is_directory(there, error)) {
    throw usage_error(there.string() + ": is a file, where a folder is to be written");
  }
  if (access(there.c_str(), W_OK | X_OK) != 0) throw system_error(there.string(), "cannot be written", errno);
  if (fs::is_directory(path, error)) require_usable(path, names_in(path), options, "", content);
}

OutputFolder::OutputFolder(fs::path path, const SinkOptions& options, const std::string& fingerprint,
                           const FolderContent& content)
    : path_(usable_folder(std::move(path), options, fingerprint, content)),
      incomplete_(path_ / kIncompleteName, path_.string()) {
  // Another run may have come and gone before the lock was taken.
  const std::vector<std::string> names = names_in(path_);
  require_usable(path_, names, options, fingerprint, content);
  incomplete_.keep_at_end();
  is_resumed_ = options.resume && !names.empty();
  if (is_resumed_) return;
  // Until the old frames are gone the mark is empty: they must never be taken for this run's.
  incomplete_.replace_content("");
  remove_file(path_ / kManifestName);
  for (const std::string& name : names) remove_content(path_ / name);
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
