#pragma once

#include <cstdint>
#include <vector>

#include "esi/sweep/cell_ledger.hpp"
#include "esi/sweep/sweep_config.hpp"

namespace esi {

/// Frames whose index leaves `first` when divided by `stride`.
struct FrameShare {
  std::int64_t stride = 1, first = 0;
};

/// Which cells are judged on which frames. A full search has one round of all cells and frames. Halving
/// (after successive halving: Jamieson & Talwalkar 2016) judges all cells on one frame of first_stride, and
/// at most the better half of them on as many again, until those left have been judged on all frames. What a
/// cell has been judged on before is not judged again.
class SweepSearch {
 public:
  /// `stride` is the one that a full search has.
  SweepSearch(const SearchOptions& options, const BootstrapOptions& bootstrap, std::int64_t stride);

  std::int64_t rounds() const { return rounds_; }
  FrameShare frames(std::int64_t round) const;

  /// Of the cells of a round, those that take part in the next: not those that are worse than the best with
  /// 95 % confidence, compared on the same frames, and of the others the better ones, as many as halving
  /// `all` cells in each round leaves.
  std::vector<std::size_t> survivors(const CellLedger& ledger, const std::vector<std::size_t>& cells,
                                     std::int64_t round, std::size_t all) const;

 private:
  SearchOptions options_;
  BootstrapOptions bootstrap_;
  std::int64_t stride_;
  std::int64_t rounds_ = 1;
};

}  // namespace esi
