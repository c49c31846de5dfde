#pragma once

#include <string>
#include <utility>
#include <vector>

#include "esi/eval/score.hpp"
#include "esi/pipeline/evaluation/evaluate.hpp"

namespace esi {

/// The scores of each method over several inputs, phases of one name as one: as if the inputs had been
/// recorded one after another. Empty for a single input, and where inputs expect different tags. A method
/// that is not in every input is left out.
std::vector<std::pair<std::string, Score>> pooled_scores(const std::vector<InputRun>& inputs,
                                                         const ScoreOptions& options);

}  // namespace esi
