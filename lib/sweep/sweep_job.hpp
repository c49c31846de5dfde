#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "esi/sweep/sweep_queue.hpp"
#include "esi/sweep/sweep_team.hpp"

namespace esi {

struct SweepJob {
  std::filesystem::path output;
  int threads = 1;
  SweepShard shard;
  SweepTeam* team = nullptr;  ///< none: this process alone
  std::string tool;           ///< "esi-sweep", for run.json
};

/// How far a sweep is: cells on recordings, of the rounds so far.
struct SweepProgress {
  std::size_t done = 0, known = 0;
};

/// Is told now and then; returns false to stop early. Called in the thread that runs the job.
using SweepObserver = std::function<bool(const SweepProgress&)>;

struct SweepReport {
  bool stopped = false;
  std::string losses;   ///< in words; empty where no input was damaged
  std::string summary;  ///< for people
};

/// Judges every cell of the grid, as its store remembers them, and fills the folder: cells.jsonl as it goes,
/// and when all is known table.csv, .md, .tex and .json, best.json, report.html, figures, and at last
/// run.json. Run again after it was stopped or killed, it goes on where it was. The same options and inputs
/// give the same results for any number of threads, processes and shards. Throws a usage Error for a grid,
/// truths and recordings that don't go together and for a folder of something else.
SweepReport run_sweep(const SweepJob& job, const SweepConfig& config, const SweepObserver& observer);

/// Puts the stores of shards together into a folder with the results. Throws an Error that says which cells
/// are missing and how to get them, and a usage Error for stores of different sweeps.
SweepReport merge_sweeps(const std::vector<std::filesystem::path>& folders, const SweepJob& job);

/// In words: cells, frames, and hours as a measurement on two seconds of the first recording has it.
std::string plan_text(const SweepConfig& config, int threads);

}  // namespace esi
