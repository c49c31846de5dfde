#pragma once

#include "esi/sweep/sweep_header.hpp"
#include "esi/sweep/sweep_outcome.hpp"
#include "esi/sweep/sweep_queue.hpp"

namespace esi {

/// What the records of a whole sweep say. The same for records in any order.
SweepOutcome outcome_of(const SweepHeader& header, std::vector<CellRecord> records);

/// Cells on recordings that a complete sweep would have and these records don't, of the first round that is
/// not complete.
std::vector<std::pair<std::size_t, std::size_t>> missing_cells(const SweepHeader& header,
                                                               const std::vector<CellRecord>& records);

}  // namespace esi
