#include "esi/pipeline/evaluation/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Names of phases and methods may hold colons, too.
bool is_meant(const Requirement& requirement, const std::string& method, const std::string& phase) {
  return requirement.name == phase || requirement.name == method + ":" + phase;
}

bool has_it(const InputRun& input, const std::string& method, const Requirement& requirement) {
  const auto& phases = input.truth.truth.phases;
  return is_meant(requirement, method, "total") ||
         std::any_of(phases.begin(), phases.end(),
                     [&](const Phase& phase) { return is_meant(requirement, method, phase.name); });
}

std::vector<std::string> labels_of(const InputRun& input, const EvalConfig& config) {
  if (input.input.is_frames) return {frames_label(input.input)};
  std::vector<std::string> labels;
  for (const EvalMethod& method : config.methods) labels.push_back(method.label);
  return labels;
}

std::vector<PhaseScore> with_total(const Score& score) {
  std::vector<PhaseScore> phases = score.phases;
  phases.push_back(score.total);
  return phases;
}

bool has_method(const InputResult& result, const std::string& label) {
  return std::any_of(result.methods.begin(), result.methods.end(),
                     [&](const MethodResult& method) { return method.label == label; });
}

}  // namespace

Requirement parse_requirement(std::string_view text) {
  Requirement requirement;
  requirement.text = text;
  const std::size_t sign = text.rfind(">=");
  const auto refuse = [&] {
    throw usage_error(
        fmt::format("--require {}: write PHASE>=RATE or METHOD:PHASE>=RATE, such as total>=0.8", text));
  };
  if (sign == std::string_view::npos || sign == 0) refuse();
  const std::string_view number = text.substr(sign + 2);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), requirement.least);
  const bool is_rate = requirement.least >= 0.0 && requirement.least <= 1.0;
  if (error != std::errc{} || end != number.data() + number.size() || !is_rate) refuse();
  requirement.name = text.substr(0, sign);
  return requirement;
}

void require_known(const Requirement& requirement, const std::vector<InputRun>& inputs,
                   const EvalConfig& config) {
  for (const InputRun& input : inputs) {
    for (const std::string& label : labels_of(input, config)) {
      if (has_it(input, label, requirement)) return;
    }
  }
  throw usage_error(fmt::format("--require {}: there is no such phase or method", requirement.text));
}

std::vector<std::string> missed(const Requirement& requirement, const std::vector<InputResult>& results) {
  std::vector<std::string> sentences;
  for (const InputResult& result : results) {
    for (const MethodResult& method : result.methods) {
      const InputResult& first = results.front();
      if (first.is_pooled && !result.is_pooled && has_method(first, method.label)) continue;
      for (const PhaseScore& phase : with_total(method.score)) {
        if (!is_meant(requirement, method.label, phase.name)) continue;
        const auto rate = phase.frames.value();
        if (rate && *rate >= requirement.least) continue;
        sentences.push_back(fmt::format("{} is missed by {} on {}: {}", requirement.text, method.label,
                                        result.is_pooled ? "all inputs together" : result.name,
                                        rate ? fmt::format("{:.4f}", *rate) : "no frames"));
      }
    }
  }
  return sentences;
}

}  // namespace esi
