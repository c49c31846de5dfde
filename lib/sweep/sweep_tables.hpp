#pragma once

#include <cstddef>

#include "esi/report/table.hpp"
#include "esi/sweep/sweep_outcome.hpp"

namespace esi {

/// For programs (table.csv): a row for each cell, each recording with "all" first (alone where there is one
/// recording), and each phase with `total` last. The difference to the best cell stands in the row of all
/// recordings and of the phase that decides. Numbers that there aren't are empty.
Table sweep_rows(const SweepOutcome& outcome);

/// Of the best cells, in tables for people.
constexpr std::size_t kShownCells = 20;

/// For people: the best cells, at most so many, with their rates. One-value axes are left out.
Table sweep_table(const SweepOutcome& outcome, std::size_t most_rows);

/// A row for each recording and one for all: what the best cell reached there.
Table best_by_recording(const SweepOutcome& outcome);

}  // namespace esi
