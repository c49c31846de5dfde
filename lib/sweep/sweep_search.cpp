#include "esi/sweep/sweep_search.hpp"

#include <algorithm>

namespace esi {

SweepSearch::SweepSearch(const SearchOptions& options, const BootstrapOptions& bootstrap, std::int64_t stride)
    : options_(options), bootstrap_(bootstrap), stride_(stride) {
  if (options_.search == SearchOptions::Search::full) options_.first_stride = 1;
  for (std::int64_t coarse = options_.first_stride; coarse > 1; coarse /= 2) ++rounds_;
}

FrameShare SweepSearch::frames(std::int64_t round) const {
  const std::int64_t finest = options_.first_stride * stride_;
  if (round == 0) return {finest, 0};
  const std::int64_t stride = finest >> (round - 1);  // of what has been judged before
  return {stride, stride / 2};
}

std::vector<std::size_t> SweepSearch::survivors(const CellLedger& ledger,
                                                const std::vector<std::size_t>& cells, std::int64_t round,
                                                std::size_t all) const {
  const std::vector<std::size_t> order = ranked(ledger, cells, options_.objective);
  const Score best = ledger.joined(order.front(), options_.objective);
  const auto is_worse = [&](std::size_t cell) {
    if (cell == order.front()) return false;
    const auto interval =
        paired_difference(ledger.joined(cell, options_.objective), best, bootstrap_).bootstrap;
    return interval && interval->high < 0.0;
  };
  const std::size_t divisor = std::size_t{2} << round;
  const std::size_t most = (all + divisor - 1) / divisor;
  std::vector<std::size_t> kept;
  for (const std::size_t cell : order) {
    if (kept.size() < most && !is_worse(cell)) kept.push_back(cell);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace esi
