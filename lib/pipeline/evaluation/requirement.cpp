#include "esi/pipeline/evaluation/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "esi/core/error.hpp"

namespace esi {
namespace {

const PhaseScore* phase_named(const Score& score, const std::string& name) {
  const auto found = std::find_if(score.phases.begin(), score.phases.end(),
                                  [&](const PhaseScore& phase) { return phase.name == name; });
  if (found != score.phases.end()) return &*found;
  return name == "total" ? &score.total : nullptr;
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
  std::string_view name = text.substr(0, sign);
  if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
    requirement.method = name.substr(0, colon);
    name.remove_prefix(colon + 1);
  }
  requirement.phase = name;
  return requirement;
}

std::vector<std::string> missed(const Requirement& requirement, const InputResult& result) {
  std::vector<std::string> sentences;
  bool is_known = false;
  for (const MethodResult& method : result.methods) {
    if (!requirement.method.empty() && method.label != requirement.method) continue;
    const PhaseScore* const phase = phase_named(method.score, requirement.phase);
    if (phase == nullptr) continue;
    is_known = true;
    const auto rate = phase->frames.value();
    if (rate && *rate >= requirement.least) continue;
    sentences.push_back(fmt::format("{} is missed by {}: {}", requirement.text, method.label,
                                    rate ? fmt::format("{:.4f}", *rate) : "no frames"));
  }
  if (is_known) return sentences;
  throw usage_error(fmt::format("--require {}: there is no such method or phase", requirement.text));
}

}  // namespace esi
