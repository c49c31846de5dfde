#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/sweep/sweep_folder.hpp"
#include "esi/sweep/sweep_job.hpp"
#include "esi/sweep/sweep_report.hpp"
#include "esi/sweep/sweep_results.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

struct Part {
  fs::path folder;
  StoreContent content;
  SweepShard shard;
};

std::vector<Part> read_parts(const std::vector<fs::path>& folders) {
  std::vector<Part> parts;
  for (const fs::path& folder : folders) {
    Part part{folder, read_store(folder), {}};
    if (part.content.header.contains("shard")) {
      part.shard = parse_shard(part.content.header["shard"].get<std::string>());
    }
    const std::string other =
        parts.empty() ? "" : difference(parts.front().content.header, part.content.header);
    if (!other.empty()) {
      throw usage_error(fmt::format("{} and {}: belong to different sweeps ({})", folders.front().string(),
                                    folder.string(), other));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The command that makes what a shard lacks; into the shard's folder, if it is among these.
std::string command_for(const std::vector<Part>& parts, const SweepShard& shard) {
  const auto is_it = [&](const Part& part) { return to_string(part.shard) == to_string(shard); };
  const auto own = std::find_if(parts.begin(), parts.end(), is_it);
  const std::string folder =
      own != parts.end() ? own->folder.string() : fmt::format("shard-{}-of-{}", shard.index, shard.count);
  const std::string config = (parts.front().folder / kSweepConfigName).string();
  return fmt::format("esi-sweep --config {}{} -o {}", config,
                     shard.is_all() ? "" : " --shard " + to_string(shard), folder);
}

[[noreturn]] void refuse_missing(const std::vector<Part>& parts, const SweepHeader& header,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& missing) {
  constexpr std::size_t kShown = 5;
  const SweepGrid grid = header.config.grid();
  const std::size_t count = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
                              return a.shard.count < b.shard.count;
                            })->shard.count;
  std::string cells, commands;
  for (std::size_t i = 0; i < std::min(missing.size(), kShown); ++i) {
    cells += fmt::format("{}{} ({}) on {}", i == 0 ? "" : "; ", missing[i].first, grid.text(missing[i].first),
                         header.recordings[missing[i].second].path);
  }
  for (std::size_t index = 1; index <= count; ++index) {
    const SweepShard shard{index, count};
    const auto lacks = [&](const auto& cell) { return shard.has(cell.first); };
    if (!std::any_of(missing.begin(), missing.end(), lacks)) continue;
    commands += (commands.empty() ? "" : " && ") + command_for(parts, shard);
  }
  throw Error(fmt::format("{} cells are missing: {}{}; make them with: {}", missing.size(), cells,
                          missing.size() > kShown ? "; ..." : "", commands));
}

}  // namespace

SweepReport merge_sweeps(const std::vector<fs::path>& folders, const SweepJob& job) {
  const auto began = std::chrono::steady_clock::now();
  if (folders.empty()) throw usage_error("give the folders of a sweep's shards");
  std::vector<Part> parts = read_parts(folders);
  const SweepHeader header = header_from(parts.front().content.header);
  nlohmann::json first_line = to_json(header);
  std::vector<CellRecord> records;
  for (Part& part : parts) {
    records.insert(records.end(), part.content.records.begin(), part.content.records.end());
  }
  if (const auto missing = missing_cells(header, records); !missing.empty()) {
    refuse_missing(parts, header, missing);
  }
  prepare_sweep_folder(job.output);
  SweepStore store(job.output, first_line);
  remove_file(job.output / kRunName);
  for (CellRecord& record : records) store.add(std::move(record));
  SweepReport report;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  report.summary = write_results(job.output, job.tool, header, store.records(), {1, wall.count()});
  report.has_results = true;
  return report;
}

}  // namespace esi
