#include "esi/sweep/sweep_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/sweep/sweep_folder.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

bool has_store(const fs::path& folder) { return is_there(folder / kStoreName); }

/// A shard that never began is missing like one that never ended. Throws where all are.
std::vector<fs::path> without_empty(const std::vector<fs::path>& folders) {
  std::vector<fs::path> begun;
  std::copy_if(folders.begin(), folders.end(), std::back_inserter(begun), has_store);
  return begun.empty() ? folders : begun;
}

/// One word for a shell.
std::string shell_word(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-+,:@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Where a shard's own folder isn't known, it is beside the first one's.
fs::path folder_of(const std::vector<SweepPart>& parts, const SweepShard& shard) {
  const auto is_it = [&](const SweepPart& part) { return to_string(part.shard) == to_string(shard); };
  const auto own = std::find_if(parts.begin(), parts.end(), is_it);
  if (own != parts.end()) return own->folder;
  const fs::path beside = (parts.front().folder / "").parent_path().parent_path();
  return beside / fmt::format("shard-{}-of-{}", shard.index, shard.count);
}

}  // namespace

std::vector<SweepPart> read_parts(const std::vector<fs::path>& folders) {
  std::vector<SweepPart> parts;
  for (const fs::path& folder : without_empty(folders)) {
    SweepPart part{folder, read_store(folder), {}};
    if (part.content.header.contains("shard")) {
      part.shard = parse_shard(part.content.header["shard"].get<std::string>());
    }
    const std::string other =
        parts.empty() ? "" : difference(parts.front().content.header, part.content.header);
    if (!other.empty()) {
      throw usage_error(fmt::format("{} and {}: belong to different sweeps ({})",
                                    parts.front().folder.string(), folder.string(), other));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

SweepHeader header_of(const std::vector<SweepPart>& parts) {
  const auto is_shorter = [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  };
  SweepHeader header = header_from(parts.front().content.header);
  for (const SweepPart& part : parts) {
    const SweepHeader other = header_from(part.content.header);
    for (std::size_t i = 0; i < header.recordings.size(); ++i) {
      SweptRecording& own = header.recordings[i];
      own.path = std::min(own.path, other.recordings[i].path, is_shorter);
      own.truth_path = std::min(own.truth_path, other.recordings[i].truth_path, is_shorter);
    }
  }
  return header;
}

fs::path config_of(const std::vector<SweepPart>& parts) {
  for (const SweepPart& part : parts) {
    if (fs::path path = part.folder / kSweepConfigName; is_there(path)) return path;
  }
  return {};
}

std::string command_for(const std::vector<SweepPart>& parts, const std::vector<SweepShard>& shards) {
  const std::string sweep = "esi-sweep --config " + shell_word(config_of(parts).string());
  std::string commands;
  for (const SweepShard& shard : shards) {
    commands += fmt::format("{}{}{} -o {}", commands.empty() ? "" : " && ", sweep,
                            shard.is_all() ? "" : " --shard " + to_string(shard),
                            shell_word(folder_of(parts, shard).string()));
  }
  return commands;
}

}  // namespace esi
