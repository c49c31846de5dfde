#pragma once

#include <string>
#include <vector>

#include "esi/pipeline/evaluation/evaluate.hpp"

namespace esi::cli {

/// Gives each input its ground truth: of `truths` the one at its place, or the only one, or without any the
/// ground_truth.json beside it. Throws a usage Error where that doesn't come out, and for standard input.
void give_truths(std::vector<EvalInput>& inputs, const std::vector<std::string>& truths);

/// Recordings with their truths.
std::vector<EvalInput> recordings_with_truths(const std::vector<std::string>& recordings,
                                              const std::vector<std::string>& truths);

}  // namespace esi::cli
