#include "esi/sweep/main_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "esi/pipeline/evaluation/number_texts.hpp"
#include "esi/sweep/value_effects.hpp"

namespace esi {
namespace {

using Effects = std::span<const ValueEffect>;

/// Below this, other parameters are not said to make up for a value: percentage points.
constexpr double kLeastRecoveryPoints = 2.0;

std::string numbers_of(const ValueEffect& effect) {
  return fmt::format("{}, 95 % {} to {}", tenths_text(*effect.points), tenths_text(effect.points95->low),
                     tenths_text(effect.points95->high));
}

template <class Predicate>
std::string listed(Effects effects, Predicate predicate) {
  std::string list;
  for (const ValueEffect& effect : effects) {
    if (predicate(effect)) list += (list.empty() ? "" : ", ") + effect.value;
  }
  return list;
}

bool is_judged(const ValueEffect& effect) { return effect.points && effect.points95; }

/// That nothing matters is said only where it is known this closely: percentage points.
constexpr double kCertainPoints = 5.0;

bool is_certain(Effects effects) {
  return std::all_of(effects.begin(), effects.end(), [](const ValueEffect& effect) {
    return effect.is_best || (is_judged(effect) && effect.points95->low > -kCertainPoints &&
                              effect.points95->high < kCertainPoints);
  });
}

/// The value that costs most; nullptr where none costs.
const ValueEffect* dearest(Effects effects) {
  const ValueEffect* found = nullptr;
  for (const ValueEffect& effect : effects) {
    if (effect.costs() && (found == nullptr || *effect.points < *found->points)) found = &effect;
  }
  return found;
}

std::string cost_text(std::string_view where, Effects effects) {
  const ValueEffect* const most = dearest(effects);
  const auto costing =
      std::count_if(effects.begin(), effects.end(), [](auto& effect) { return effect.costs(); });
  return fmt::format("{} it costs {}{:.1f} points ({}: {})", where, costing > 1 ? "up to " : "",
                     -*most->points, most->value, numbers_of(*most));
}

std::string unjudged_text(Effects effects) {
  const std::string list =
      listed(effects, [](const ValueEffect& effect) { return !effect.is_best && !is_judged(effect); });
  return list.empty() ? "" : fmt::format(" Too few frames to tell: {}.", list);
}

std::string no_effect(const SweepAxis& axis, Effects effects) {
  const ValueEffect* largest = nullptr;
  for (const ValueEffect& effect : effects) {
    if (effect.is_best || !is_judged(effect)) continue;
    if (largest == nullptr || std::abs(*effect.points) > std::abs(*largest->points)) largest = &effect;
  }
  if (largest == nullptr) return fmt::format("{}: too few frames to tell.", axis.option);
  const std::string range =
      axis.numbers.empty() ? fmt::format("({})", listed(effects, [](const auto&) { return true; }))
                           : fmt::format("between {} and {}", effects.front().value, effects.back().value);
  if (std::abs(*largest->points) < kLeastEffectPoints && is_certain(effects)) {
    return fmt::format("{} does not matter {}: within {:.1f} points.{}", axis.option, range,
                       std::abs(*largest->points), unjudged_text(effects));
  }
  return fmt::format("{}: no difference is told {} (the largest is at {}: {}); more frames may tell one.{}",
                     axis.option, range, largest->value, numbers_of(*largest), unjudged_text(effects));
}

/// Values around the best one of which none costs: [begin, end).
struct Plateau {
  std::size_t begin = 0, end = 0;
};

Plateau plateau_of(Effects effects) {
  const auto best = std::find_if(effects.begin(), effects.end(), [](auto& effect) { return effect.is_best; });
  Plateau plateau{static_cast<std::size_t>(best - effects.begin()), 0};
  plateau.end = plateau.begin + 1;
  while (plateau.begin > 0 && !effects[plateau.begin - 1].costs()) --plateau.begin;
  while (plateau.end < effects.size() && !effects[plateau.end].costs()) ++plateau.end;
  return plateau;
}

std::string plateau_text(Effects effects, const Plateau& plateau) {
  const std::string &first = effects[plateau.begin].value, &last = effects[plateau.end - 1].value;
  if (plateau.end - plateau.begin == 1) return first + " is best";
  if (plateau.end == effects.size()) return fmt::format("from {} on no difference is told", first);
  if (plateau.begin == 0) return fmt::format("up to {} no difference is told", last);
  return fmt::format("between {} and {} no difference is told", first, last);
}

std::string beyond_text(Effects effects) {
  if (!effects.front().is_best && !effects.back().is_best) return {};
  const bool is_first = effects.front().is_best;
  return fmt::format(" The best, {}, is the {} value tried: the best may lie beyond it.",
                     is_first ? effects.front().value : effects.back().value,
                     is_first ? "smallest" : "largest");
}

std::string effect_of_numbers(Effects effects) {
  const Plateau plateau = plateau_of(effects);
  const Effects below = effects.first(plateau.begin), above = effects.subspan(plateau.end);
  std::string text;
  if (!below.empty()) text += cost_text("below " + effects[plateau.begin].value, below);
  if (!above.empty()) {
    text += (below.empty() ? "" : "; ") + cost_text("above " + effects[plateau.end - 1].value, above);
  }
  text += "; " + plateau_text(effects, plateau);
  std::string others;
  for (const Effects side : {below, above}) {
    const std::string list = listed(side, [](auto& effect) { return is_judged(effect) && !effect.costs(); });
    if (!list.empty()) others += (others.empty() ? "" : ", ") + list;
  }
  if (!others.empty()) text += fmt::format("; at {} no difference is told either", others);
  return text + "." + beyond_text(effects);
}

std::string effect_of_names(Effects effects) {
  std::string text;
  for (const ValueEffect& effect : effects) {
    if (!effect.costs()) continue;
    text += fmt::format("{}{} costs {:.1f} points ({})", text.empty() ? "" : "; ", effect.value,
                        -*effect.points, numbers_of(effect));
  }
  text += fmt::format("; {} is best", listed(effects, [](auto& effect) { return effect.is_best; }));
  const std::string equal =
      listed(effects, [](auto& effect) { return !effect.is_best && is_judged(effect) && !effect.costs(); });
  return text + (equal.empty() ? "." : fmt::format(", no difference is told of {}.", equal));
}

/// Whether the others can make up for the dearest value.
std::string recovery_text(Effects effects) {
  const ValueEffect* const most = dearest(effects);
  if (!most->anew_points || *most->anew_points - *most->points < kLeastRecoveryPoints) return {};
  if (!most->anew_costs) {
    return fmt::format(" With the other parameters chosen anew no difference is told at {}.", most->value);
  }
  return fmt::format(" With the other parameters chosen anew {} costs {:.1f} points.", most->value,
                     -*most->anew_points);
}

std::string main_effect(const SweepAxis& axis, Effects effects) {
  if (dearest(effects) == nullptr) return no_effect(axis, effects);
  return fmt::format("{} matters: {}{}{}", axis.option,
                     axis.numbers.empty() ? effect_of_names(effects) : effect_of_numbers(effects),
                     recovery_text(effects), unjudged_text(effects));
}

}  // namespace

std::vector<std::string> main_effects(const SweepOutcome& outcome) {
  std::vector<std::string> sentences;
  const std::vector<SweepAxis>& axes = outcome.grid.axes();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].values.size() > 1) sentences.push_back(main_effect(axes[i], value_effects(outcome, i)));
  }
  return sentences;
}

}  // namespace esi
