#pragma once

#include <optional>
#include <string>
#include <vector>

#include "esi/eval/statistics.hpp"

namespace esi {

// Numbers as tables have them. A number that there isn't is empty for programs, "-" for people.

std::string decimal_text(const std::optional<double>& number, int decimals);

/// For people: "12/48 (25.0 %)".
std::string share_text(const Rate& rate);

/// For people: one decimal, never "-0.0".
std::string tenths_text(double number);

/// For people, in percent: "20.1..30.4".
std::string percent_range_text(const std::optional<ConfidenceInterval>& interval);

/// For programs: two cells, its low and its high end.
void add_interval(std::vector<std::string>& row, const std::optional<ConfidenceInterval>& interval);

}  // namespace esi
