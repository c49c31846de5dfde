#pragma once

#include <functional>

#include "esi/core/row_team.hpp"

namespace esi {

/// Makes row y of stage k, counted from 0: from its rows y - 1 to y + 1 of stage k - 1, row y of those
/// before, and what all threads may read.
using StageRow = std::function<void(int k, int y)>;

/// Stages over an image's rows in one pass: each follows a row behind the one before it, while a few rows of
/// all are in cache. Where the rows are cut for the team, each stage ends a row earlier than the one before
/// it; what is then left at the cuts is made last. `piece` and `seam` give each part of the work its
/// StageRow: a piece has all stages of its rows in turn, a seam begins with stage 1.
void over_stages(const RowTeam& team, cv::Size image, int stages, const std::function<StageRow()>& piece,
                 const std::function<StageRow()>& seam);

}  // namespace esi
