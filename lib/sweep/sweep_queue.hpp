#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "esi/sweep/sweep_store.hpp"
#include "esi/sweep/sweep_work.hpp"

namespace esi {

/// Part i of n of the cells: every n-th one, 1 <= i <= n.
struct SweepShard {
  std::size_t index = 1, count = 1;

  bool has(std::size_t cell) const { return cell % count == index - 1; }
  bool is_all() const { return count == 1; }
};

/// "2/3". Throws a usage Error for what is none.
SweepShard parse_shard(const std::string& text);
std::string to_string(const SweepShard& shard);

/// How blocks are cut.
struct BlockLimits {
  std::size_t workers = 1;     ///< who ask for blocks; none shall wait long for the others at the end
  std::size_t most_cells = 1;  ///< in memory at the same time
  double seconds = 60.0;       ///< about as long a block takes: what a kill can lose
};

/// What there is to do for someone who can't wait.
struct SweepTurn {
  std::optional<SweepBlock> block;
  bool has_ended = false;  ///< without a block: there will be none any more, not only none yet
};

/// Everything that a sweep has still to do, round by round, kept in the store as it is done.
class SweepQueue final : public SweepWork {
 public:
  /// What is referred to must outlive the queue.
  SweepQueue(SweepStore& store, const SweepHeader& header, SweepShard shard, BlockLimits limits);

  std::optional<SweepBlock> next() override;
  void finish(const SweepBlock& block, std::vector<CellRecord> records, double seconds) override;
  void stop() override;

  /// As next(), but where that would wait the turn has neither a block nor ended.
  SweepTurn try_next();

  bool is_stopped() const;
  /// Nothing is left, nothing was stopped.
  bool is_complete() const;
  /// Waits until nothing is left or it was stopped, but not longer. Whether that is so.
  bool wait_for_end(std::chrono::milliseconds longest);
  /// Cells on recordings, of the rounds so far: done and known to be done.
  std::pair<std::size_t, std::size_t> progress() const;

 private:
  void begin_round();
  bool advance();
  SweepTurn take_turn();
  std::size_t block_cells(std::size_t recording) const;

  SweepStore& store_;
  const SweepHeader& header_;
  SweepShard shard_;
  BlockLimits limits_;
  SweepSearch search_;
  CellLedger ledger_;  ///< of the rounds so far

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t round_ = 0;
  std::vector<std::size_t> cells_;                ///< of this round
  std::vector<std::deque<std::size_t>> waiting_;  ///< [recording]: cells
  std::size_t in_progress_ = 0;                   ///< blocks
  std::size_t done_ = 0, known_ = 0;
  double seconds_per_cell_second_ = 0.0;  ///< of a recording; 0 before the first block is done
  bool is_stopped_ = false, is_complete_ = false;
};

}  // namespace esi
