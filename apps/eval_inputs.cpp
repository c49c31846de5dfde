#include "eval_inputs.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"

namespace esi::cli {
namespace {

namespace fs = std::filesystem;

/// The truth that stands beside an input under its usual name.
fs::path truth_beside(const EvalInput& input) {
  const fs::path folder = input.is_frames ? input.path : input.path.parent_path();
  fs::path truth = folder / "ground_truth.json";
  std::error_code absent;
  if (fs::exists(truth, absent)) return truth;
  throw usage_error(fmt::format("{}: say with -g where its ground truth is; there is no {} beside it",
                                input.path.string(), truth.string()));
}

}  // namespace

void give_truths(std::vector<EvalInput>& inputs, const std::vector<std::string>& truths) {
  if (truths.size() > 1 && truths.size() != inputs.size()) {
    throw usage_error(
        fmt::format("{} ground truths for {} inputs: give one each, in their order, or one for all",
                    truths.size(), inputs.size()));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].path.empty() || inputs[i].path == "-") {
      throw usage_error("recordings must be files that can be opened by name, not standard input");
    }
    inputs[i].truth = truths.empty() ? truth_beside(inputs[i]) : fs::path(truths[truths.size() == 1 ? 0 : i]);
  }
}

std::vector<EvalInput> recordings_with_truths(const std::vector<std::string>& recordings,
                                              const std::vector<std::string>& truths) {
  std::vector<EvalInput> inputs;
  inputs.reserve(recordings.size());
  for (const std::string& path : recordings) inputs.push_back({path, {}, false});
  give_truths(inputs, truths);
  return inputs;
}

}  // namespace esi::cli
