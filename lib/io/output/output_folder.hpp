#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "esi/io/output/frame_sink.hpp"
#include "esi/io/output/lock_file.hpp"

namespace esi {

/// What a tool's folder may hold: what --force replaces.
struct FolderContent {
  const char* what;                           ///< "a reconstruction"
  bool (*has_file)(std::string_view name);    ///< of a file in it
  bool (*has_folder)(std::string_view name);  ///< of a folder in it, which holds numbered pictures and lists
  bool can_be_resumed;
};

/// Frames, their lists and run.json.
extern const FolderContent kReconstructionContent;

/// "frame_", digits, ".png".
bool is_picture_name(std::string_view name);

/// What stands at "fingerprint" in a JSON file such as run.json; empty where there is none.
std::optional<std::string> fingerprint_in(const std::filesystem::path& json_file);

/// Throws what an OutputFolder of that path would throw, as far as can be told before: for a run that does
/// all its work first. Leaves everything as it is.
void require_usable_folder(const std::filesystem::path& path, const SinkOptions& options,
                           const FolderContent& content);

/// The folder that one run fills, held by one run at a time. While it is incomplete it holds
/// .esi-incomplete with the run's fingerprint.
class OutputFolder {
 public:
  /// Makes the folder and what leads to it. Throws a usage Error for a folder that is not empty, unless
  /// options.force (replaces such content, and refuses if there is anything else) or options.resume (needs an
  /// incomplete folder of the same fingerprint).
  OutputFolder(std::filesystem::path path, const SinkOptions& options, const std::string& fingerprint,
               const FolderContent& content = kReconstructionContent);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frame_path(std::int64_t index) const;

  /// Whether frames of an interrupted run may be there.
  bool is_resumed() const { return is_resumed_; }

  /// Removes the frames from `begin` on.
  void remove_frames(std::int64_t begin) const;

  /// Writes run.json and takes the mark of the incomplete away.
  void complete(const std::string& manifest);

 private:
  std::filesystem::path path_;
  LockFile incomplete_;
  bool is_resumed_ = false;
};

}  // namespace esi
