#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/stopwatch.hpp"
#include "esi/sweep/sweep_folder.hpp"
#include "esi/sweep/sweep_job.hpp"
#include "esi/sweep/sweep_parts.hpp"
#include "esi/sweep/sweep_report.hpp"
#include "esi/sweep/sweep_results.hpp"

namespace esi {
namespace {

namespace fs = std::filesystem;

void refuse_as_output(const fs::path& folder, const fs::path& output) {
  std::error_code error;
  if (!fs::equivalent(folder, output, error)) return;
  throw usage_error(fmt::format("-o {}: is one of the shards; choose a folder of its own", output.string()));
}

[[noreturn]] void refuse_missing(const std::vector<SweepPart>& parts, const SweepHeader& header,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& missing) {
  constexpr std::size_t kShown = 5;
  const SweepGrid grid = header.config.grid();
  std::string cells;
  for (std::size_t i = 0; i < std::min(missing.size(), kShown); ++i) {
    cells += fmt::format("{}{} ({}) on {}", i == 0 ? "" : "; ", missing[i].first, grid.text(missing[i].first),
                         header.recordings[missing[i].second].path);
  }
  std::size_t count = 1;
  for (const SweepPart& part : parts) count = std::max(count, part.shard.count);
  std::vector<SweepShard> lacking;
  for (SweepShard shard{1, count}; shard.index <= count; ++shard.index) {
    const auto lacks = [&](const auto& cell) { return shard.has(cell.first); };
    if (std::any_of(missing.begin(), missing.end(), lacks)) lacking.push_back(shard);
  }
  const std::string more =
      lacking.size() > kShown ? fmt::format(" (and {} more shards)", lacking.size() - kShown) : "";
  lacking.resize(std::min(lacking.size(), kShown));
  throw Error(fmt::format("{} cells are missing: {}{}; make them with: {}{}", missing.size(), cells,
                          missing.size() > kShown ? "; ..." : "", command_for(parts, lacking), more));
}

}  // namespace

SweepReport merge_sweeps(const std::vector<fs::path>& folders, const SweepJob& job) {
  const Stopwatch watch;
  if (folders.empty()) throw usage_error("give the folders of a sweep's shards");
  for (const fs::path& folder : folders) refuse_as_output(folder, job.output);
  std::vector<SweepPart> parts = read_parts(folders);
  const SweepHeader header = header_of(parts);
  std::vector<CellRecord> records;
  for (const SweepPart& part : parts) {
    records.insert(records.end(), part.content.records.begin(), part.content.records.end());
  }
  if (const auto missing = missing_cells(header, records); !missing.empty()) {
    refuse_missing(parts, header, missing);
  }
  prepare_sweep_folder(job.output);
  SweepStore store(job.output, to_json(header));
  remove_file(job.output / kRunName);
  if (const fs::path config = config_of(parts); !config.empty()) {
    write_file(job.output / kSweepConfigName, read_text_file(config));
  }
  store.add(std::move(records));
  SweepReport report;
  report.summary = write_results(job.output, job.tool, header, store.records(), {1, watch.seconds()});
  report.losses = losses_of(header);
  return report;
}

}  // namespace esi
