#include "esi/io/text/columns.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "esi/io/text/numbers.hpp"

namespace esi {
namespace {

constexpr std::size_t kMaxColumns = 32;

bool all_numbers(std::span<const std::string_view> fields, std::span<const bool> is_ignored) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!is_ignored[i] && !split_decimal(fields[i])) return false;
  }
  return true;
}

// Whether four columns can be what `order` calls them.
bool fits(std::span<const ColumnStatistics> columns, std::string_view order) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ColumnStatistics& column = columns[i];
    const bool is_coordinate = order[i] == 'x' || order[i] == 'y';
    if (is_coordinate && !column.holds_coordinates()) return false;
    if (order[i] == 'p' && !column.holds_polarity()) return false;
  }
  return true;
}

// Whether another column than `t` looks like the time: it only rises, and this one goes up and down.
bool is_outdone(std::span<const ColumnStatistics> columns, std::size_t t) {
  if (!columns[t].is_disordered()) return false;
  return std::any_of(columns.begin(), columns.end(), [&](const ColumnStatistics& column) {
    return &column != &columns[t] && column.is_sorted() && column.rises > 0 && !column.holds_polarity();
  });
}

}  // namespace

void ColumnStatistics::add(std::string_view number) {
  const auto decimal = split_decimal(number);
  if (!decimal) return;
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0;
  std::from_chars(number.data(), number.data() + number.size(), value);
  if (numbers > 0) {
    rises += value > previous ? 1 : 0;
    falls += value < previous ? 1 : 0;
  }
  previous = value;
  ++numbers;
  points += decimal->has_point ? 1 : 0;
  if (value != std::floor(value) || std::abs(value) > 65535) return;
  ++coordinates;
  if (value >= -1 && value <= 2) ++values[static_cast<std::size_t>(value + 1)];
}

std::int64_t ColumnStatistics::in_code(PolarityCode code) const {
  switch (code) {
    case PolarityCode::minus_plus_one:
      return values[0] + values[2];
    case PolarityCode::one_two:
      return values[2] + values[3];
    case PolarityCode::zero_one:
      return values[1] + values[2];
    case PolarityCode::automatic:
      break;
  }
  return values[2];
}

PolarityCode ColumnStatistics::polarity() const {
  PolarityCode best = PolarityCode::automatic;
  for (const auto code : {PolarityCode::zero_one, PolarityCode::minus_plus_one, PolarityCode::one_two}) {
    if (in_code(code) > in_code(best)) best = code;
  }
  return best;
}

bool ColumnStatistics::holds_polarity() const { return in_code(polarity()) * 10 >= numbers * 9; }

std::vector<ColumnStatistics> column_statistics(std::string_view lines, char separator,
                                                std::span<const bool> is_ignored) {
  std::vector<ColumnStatistics> columns(is_ignored.size());
  std::array<std::string_view, kMaxColumns> fields;
  while (!lines.empty()) {
    const std::size_t size = std::min(lines.find('\n'), lines.size() - 1) + 1;
    const std::string_view line = trimmed(lines.substr(0, size));
    lines.remove_prefix(size);
    if (is_comment(line) || split_fields(line, separator, fields) != columns.size()) continue;
    if (!all_numbers(std::span(fields).first(columns.size()), is_ignored)) continue;
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].add(fields[i]);
  }
  return columns;
}

std::string detect_order(std::span<const ColumnStatistics> columns, bool is_metavision,
                         std::string& suggestion) {
  const bool txyp = fits(columns, "txyp") && !is_outdone(columns, 0);
  const bool xypt = fits(columns, "xypt") && !is_outdone(columns, 3);
  if (xypt && (is_metavision || !txyp)) return "xypt";
  if (txyp) return "txyp";

  std::string order = "ptxy";
  do {
    const std::size_t t = order.find('t');
    const bool is_time = columns[t].is_sorted() && columns[t].rises > 0;
    if (is_time && order.find('x') < order.find('y') && fits(columns, order)) suggestion = order;
  } while (suggestion.empty() && std::next_permutation(order.begin(), order.end()));
  return "";
}

}  // namespace esi
