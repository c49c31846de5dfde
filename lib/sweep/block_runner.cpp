#include "esi/sweep/block_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "esi/core/error.hpp"
#include "esi/pipeline/stopwatch.hpp"

namespace esi {
namespace {

constexpr std::uint64_t kBlockBytes = std::uint64_t{1} << 30;
/// Of each cell beside its method's state: the frames that wait for a detector, and those that are shown.
constexpr std::uint64_t kCellBytesPerPixel = 48;

}  // namespace

BlockRunner::BlockRunner(const SweepHeader& header, const std::vector<InputRun>& runs,
                         const Observer& observer)
    : header_(header), runs_(runs), observer_(observer), grid_(header.config.grid()) {}

std::optional<std::vector<CellRecord>> BlockRunner::run(const SweepBlock& block) const {
  EvalConfig config = header_.config.eval_config(grid_, block.cells);
  config.judging.stride = block.frames.stride;
  config.judging.first_frame = block.frames.first;
  InputRun input;
  input.input = runs_[block.recording].input;
  input.truth = runs_[block.recording].truth;
  Evaluation evaluation = evaluate(config, {std::move(input)}, 1, observer_);
  if (evaluation.stopped) return std::nullopt;
  const InputRun& done = evaluation.inputs.front();
  if (done.digest->crc32() != header_.recordings[block.recording].crc32) {
    throw Error(done.input.path.string() + ": has changed since the sweep began");
  }
  std::vector<CellRecord> records;
  for (std::size_t i = 0; i < block.cells.size(); ++i) {
    const Score found = score(done.truth.truth.phases, done.truth.expected, done.truth.corner_track(),
                              done.methods[i].frames, config.score);
    records.push_back(cell_record(block.cells[i], block.recording, block.round, found));
  }
  return records;
}

std::size_t BlockRunner::most_cells() const {
  std::uint64_t pixels = 1;
  for (const InputRun& run : runs_) {
    pixels = std::max(pixels, static_cast<std::uint64_t>(run.size.width_px) *
                                  static_cast<std::uint64_t>(run.size.height_px));
  }
  const std::uint64_t cell_bytes =
      pixels * (kCellBytesPerPixel + header_.config.base.method().state_bytes_per_pixel);
  return static_cast<std::size_t>(std::max<std::uint64_t>(1, kBlockBytes / cell_bytes));
}

void run_blocks(SweepWork& work, const BlockRunner& runner, int threads,
                const std::function<void()>& meanwhile) {
  std::mutex mutex;
  std::exception_ptr failure;
  const auto guarded = [&](const auto& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      work.stop();
    }
  };
  const auto work_off = [&] {
    while (const auto block = work.next()) {
      const Stopwatch watch;
      auto records = runner.run(*block);
      if (!records) return work.stop();
      work.finish(*block, std::move(*records), watch.seconds());
    }
  };
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) others.emplace_back([&] { guarded(work_off); });
  if (meanwhile) guarded(meanwhile);
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace esi
