#include "esi/sweep/sweep_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/ready_method.hpp"
#include "esi/pipeline/stopwatch.hpp"
#include "esi/sweep/block_runner.hpp"
#include "esi/sweep/remote_work.hpp"
#include "esi/sweep/sweep_desk.hpp"
#include "esi/sweep/sweep_folder.hpp"
#include "esi/sweep/sweep_report.hpp"

namespace esi {
namespace {

constexpr std::chrono::milliseconds kTick{100};

void refuse_unknown_objective(const SweepConfig& config, const SweepHeader& header) {
  const std::string& objective = config.search.objective;
  if (objective == "total") return;
  for (const SweptRecording& recording : header.recordings) {
    for (const Phase& phase : recording.phases) {
      if (phase.name == objective) return;
    }
  }
  throw usage_error(fmt::format("option objective: no ground truth has a phase '{}'", objective));
}

void check_job(const SweepJob& job, const SweepConfig& config, const std::function<bool()>& goes_on) {
  config.check(goes_on);
  if (config.inputs.empty()) throw usage_error("give a recording");
  const bool is_halving = config.search.search == SearchOptions::Search::halving;
  if (is_halving && !job.shard.is_all()) {
    throw usage_error("--shard goes with a full search: halving compares all cells with one another");
  }
}

/// Before anything is written: whether recordings have what the method needs, and files are what they should
/// be. Cells that are not possible by themselves have been found by check().
void try_first_cell(const SweepConfig& config, const std::vector<InputRun>& runs) {
  const ReconConfig cell = config.cell_config(config.grid(), 0);
  for (const InputRun& run : runs) {
    ReadOptions read = config.base.read;
    read.size = to_string(run.size);
    const auto recording = open_recording(run.input.path, read);
    const SensorSize sensor = recording->sensor_size().value_or(run.size);
    const std::string name = run.input.path.string();
    const ReadyMethod ready(
        cell, {run.input.path, name, read, &recording->header(), sensor, config.base.frames.region()});
  }
}

/// One process' part in a sweep.
class Sweeper {
 public:
  Sweeper(const SweepJob& job, const SweepConfig& config, const SweepObserver& observer)
      : job_(job), config_(config), observer_(observer) {}

  SweepReport run() {
    check_job(job_, config_, [this] { return tell({}); });
    if (is_stopping_) return stopped();
    header_ = survey(config_, runs_, [this](const Progress&) { return tell({}); });
    if (is_stopping_) return stopped();
    refuse_unknown_objective(config_, header_);
    try_first_cell(config_, runs_);
    return job_.team == nullptr || job_.team->is_leader() ? lead() : follow();
  }

 private:
  bool tell(const SweepProgress& progress) {
    if (observer_ && !observer_(progress)) is_stopping_ = true;
    return !is_stopping_;
  }

  static SweepReport stopped() {
    SweepReport report;
    report.stopped = true;
    return report;
  }

  SweepReport lead() {
    prepare_sweep_folder(job_.output);
    SweepStore store(job_.output, first_line());
    header_ = store.header();
    remove_file(job_.output / kRunName);
    write_file(job_.output / kSweepConfigName, json_text(config_.json_with_inputs()));
    SweepQueue queue(store, header_, job_.shard, limits());
    const Observer go_on = [&](const Progress&) { return !queue.is_stopped(); };
    const BlockRunner runner(header_, runs_, go_on);
    if (job_.team != nullptr && !job_.team->begin()) return {};  // another one says why
    run_blocks(queue, runner, job_.threads, [&] { watch(queue); });
    if (!queue.is_complete()) return stopped();
    return report(store, queue.progress().second);
  }

  nlohmann::json first_line() const {
    nlohmann::json line = to_json(header_);
    if (!job_.shard.is_all()) line["shard"] = to_string(job_.shard);
    return line;
  }

  BlockLimits limits() const {
    const int processes = job_.team == nullptr ? 1 : job_.team->processes();
    BlockLimits limits;
    limits.workers = static_cast<std::size_t>(job_.threads) * static_cast<std::size_t>(processes);
    limits.most_cells = BlockRunner(header_, runs_, {}).most_cells();
    return limits;
  }

  void watch(SweepQueue& queue) {
    const auto tick = [&] {
      const auto [done, known] = queue.progress();
      if (!tell({done, known})) queue.stop();
    };
    if (job_.team == nullptr) {
      while (!queue.wait_for_end(kTick)) tick();
      return;
    }
    SweepDesk desk(queue, header_);
    job_.team->serve([&](const std::string& question) { return desk.answer(question); }, tick);
    desk.rethrow();
  }

  SweepReport report(const SweepStore& store, std::size_t cells) {
    SweepReport report;
    report.losses = losses_of(header_);
    if (!job_.shard.is_all()) {
      report.summary = fmt::format(
          "shard {}: all its cells ({} on the recordings) are in {}; esi-sweep merge puts the shards "
          "together\n",
          to_string(job_.shard), cells, job_.output.string());
      return report;
    }
    report.summary =
        write_results(job_.output, job_.tool, header_, store.records(), {job_.threads, watch_.seconds()});
    return report;
  }

  SweepReport follow() {
    if (!job_.team->begin()) return {};  // another one says why
    RemoteWork work(*job_.team, header_);
    const Observer go_on = [&](const Progress&) { return !work.has_ended(); };
    const BlockRunner runner(header_, runs_, go_on);
    run_blocks(work, runner, job_.threads, [&] {
      while (!work.wait_for_end(kTick)) {
        if (!tell({})) work.stop();
      }
    });
    SweepReport report;
    report.stopped = is_stopping_;
    return report;
  }

  const SweepJob& job_;
  const SweepConfig& config_;
  const SweepObserver& observer_;
  Stopwatch watch_;
  std::atomic<bool> is_stopping_{false};
  SweepHeader header_;
  std::vector<InputRun> runs_;
};

}  // namespace

SweepReport run_sweep(const SweepJob& job, const SweepConfig& config, const SweepObserver& observer) {
  return Sweeper(job, config, observer).run();
}

}  // namespace esi
