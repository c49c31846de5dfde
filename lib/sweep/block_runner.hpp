#pragma once

#include <optional>
#include <string>
#include <vector>

#include "esi/sweep/sweep_header.hpp"
#include "esi/sweep/sweep_work.hpp"

namespace esi {

/// Judges blocks of cells. Can be used by several threads at once.
class BlockRunner {
 public:
  /// `runs` as survey() left them. What is referred to must outlive this.
  BlockRunner(const SweepHeader& header, const std::vector<InputRun>& runs, const Observer& observer);

  /// A record for each cell; nothing when the observer stopped it. Throws an Error where the recording isn't
  /// the one that was surveyed.
  std::optional<std::vector<CellRecord>> run(const SweepBlock& block) const;

  /// How many cells' pixels fit into about a gigabyte, at least 1.
  std::size_t most_cells() const;

 private:
  const SweepHeader& header_;
  const std::vector<InputRun>& runs_;
  const Observer& observer_;
  SweepGrid grid_;
};

/// Takes blocks and judges them in so many threads until there are no more; `meanwhile` runs in the calling
/// thread beside them. Rethrows the first error of any of them, when all have ended.
void run_blocks(SweepWork& work, const BlockRunner& runner, int threads,
                const std::function<void()>& meanwhile);

}  // namespace esi
