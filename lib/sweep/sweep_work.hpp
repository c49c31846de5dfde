#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "esi/sweep/cell_record.hpp"
#include "esi/sweep/sweep_search.hpp"

namespace esi {

/// Cells that advance together through one recording, which is decoded once for all of them.
struct SweepBlock {
  std::size_t recording = 0;
  std::int64_t round = 0;
  FrameShare frames;
  std::vector<std::size_t> cells;
};

/// Where blocks come from and what is found goes to. Used by several threads at once.
class SweepWork {
 public:
  virtual ~SweepWork() = default;

  /// The next block; waits where others must end before it is known. Nothing when there is no more.
  virtual std::optional<SweepBlock> next() = 0;

  /// A block is done: a record for each of its cells, and how long it took.
  virtual void finish(const SweepBlock& block, std::vector<CellRecord> records, double seconds) = 0;

  /// Nobody gets another block.
  virtual void stop() = 0;
};

}  // namespace esi
