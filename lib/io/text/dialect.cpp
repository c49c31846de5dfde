#include "esi/io/text/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"
#include "esi/io/text/columns.hpp"

namespace esi {
namespace {

std::vector<TextColumn> columns_from(std::string_view order) {
  std::vector<TextColumn> columns;
  for (const char c : order) columns.push_back(static_cast<TextColumn>(std::string_view("txyp").find(c)));
  return columns;
}

std::string names_of(std::span<const TextColumn> columns) {
  static constexpr std::string_view kNames[] = {"t", "x", "y", "p", "-"};
  std::string names;
  for (const TextColumn column : columns) {
    names += names.empty() ? "" : ",";
    names += kNames[static_cast<std::size_t>(column)];
  }
  return names;
}

/// Decides step by step, each on what the steps before it found.
class Decision {
 public:
  Decision(const ReadOptions& options, const TextPreamble& preamble, std::string_view lines,
           const std::string& name, RecordingHeader& header)
      : options_(options), preamble_(preamble), lines_(lines), name_(name), header_(header) {}

  TextDialect dialect() {
    find_first_line();
    find_named_columns();
    look_at_columns();
    if (dialect_.columns.empty()) detect_columns();
    check_coordinates();
    decide_unit();
    decide_polarity();
    header_.sensor = preamble_.sensor;
    header_.layout =
        fmt::format("{}, columns {}", dialect_.separator == ',' ? "csv" : "text", names_of(dialect_.columns));
    return dialect_;
  }

 private:
  void find_first_line();
  void find_named_columns();
  void look_at_columns();
  void detect_columns();
  void check_coordinates() const;
  void decide_unit();
  void decide_polarity();

  void note(std::string sentence) { header_.notes.push_back(std::move(sentence)); }
  const ColumnStatistics& statistics(TextColumn column) const {
    const auto at = std::find(dialect_.columns.begin(), dialect_.columns.end(), column);
    return statistics_[static_cast<std::size_t>(at - dialect_.columns.begin())];
  }
  std::string where() const {
    return fmt::format("{}: line {} {}", name_, first_line_number_, shown(first_line_));
  }

  const ReadOptions& options_;
  const TextPreamble& preamble_;
  std::string_view lines_;
  const std::string& name_;
  RecordingHeader& header_;

  TextDialect dialect_;
  std::string_view first_line_;
  std::int64_t first_line_number_ = 0;
  std::vector<ColumnStatistics> statistics_;
};

void Decision::find_first_line() {
  first_line_number_ = preamble_.lines + 1;
  first_line_ = lines_.substr(0, lines_.find('\n'));
  dialect_.has_carriage_returns = first_line_.ends_with('\r');
  first_line_ = trimmed(first_line_);
  if (first_line_.find(',') != std::string_view::npos) {
    dialect_.separator = ',';
  } else if (first_line_.find('\t') < first_line_.find(' ')) {
    dialect_.separator = '\t';
  }
}

void Decision::find_named_columns() {
  if (!options_.columns.empty()) {
    dialect_.columns = columns_from(options_.columns);
    return;
  }
  dialect_.columns = preamble_.columns;
  if (preamble_.columns.empty() && !preamble_.names.empty()) {
    throw Error(
        fmt::format("{}: line {} {} names no columns t, x, y, p; give their order with --columns, such "
                    "as txyp",
                    name_, preamble_.names_line, shown(preamble_.names)));
  }
  const auto is_other = [](TextColumn column) { return column == TextColumn::other; };
  if (std::any_of(dialect_.columns.begin(), dialect_.columns.end(), is_other)) {
    note("columns that are not t, x, y or p are ignored");
  }
}

void Decision::look_at_columns() {
  const std::size_t expected = dialect_.columns.empty() ? 4 : dialect_.columns.size();
  std::array<std::string_view, 32> fields;
  const std::size_t found = split_fields(first_line_, dialect_.separator, fields);
  if (found != expected) {
    const bool may_be_decimal_comma =
        dialect_.separator == ',' && first_line_.find(' ') != std::string_view::npos;
    throw Error(fmt::format(
        "{} has {} column{}, not {}; write one event a line, such as \"0.001 10 20 1\" (t x y p){}", where(),
        found, found == 1 ? "" : "s", expected,
        may_be_decimal_comma ? ", with decimal points, not commas" : ""));
  }
  std::array<bool, 32> is_ignored{};
  for (std::size_t i = 0; i < dialect_.columns.size(); ++i) {
    is_ignored[i] = dialect_.columns[i] == TextColumn::other;
  }
  statistics_ = column_statistics(lines_, dialect_.separator, std::span(is_ignored).first(expected));
  const auto any_numbers = [](const ColumnStatistics& column) { return column.numbers > 0; };
  if (std::none_of(statistics_.begin(), statistics_.end(), any_numbers)) {
    throw Error(
        fmt::format("{} is not an event, nor are the lines after it; write four decimal numbers a line, "
                    "such as \"0.001 10 20 1\" (t x y p)",
                    where()));
  }
}

void Decision::detect_columns() {
  std::string suggestion;
  const std::string order = detect_order(statistics_, preamble_.has_geometry, suggestion);
  if (order.empty() && !suggestion.empty()) {
    throw Error(
        fmt::format("{} and the lines after it are not t x y p; give their order, perhaps --columns {}",
                    where(), suggestion));
  }
  if (order.empty()) {
    throw Error(fmt::format(
        "{} and the lines after it are not t x y p with whole coordinates and a polarity of 0/1, -1/1 "
        "or 1/2; give the order with --columns, such as txyp",
        where()));
  }
  dialect_.columns = columns_from(order);
  note(order == "txyp" ? "no line names the columns: taken as t, x, y, p"
                       : "no line names the columns: the third is plainly the polarity, taken as x, y, p, t");
}

void Decision::check_coordinates() const {
  for (const TextColumn column : {TextColumn::x, TextColumn::y}) {
    if (statistics(column).holds_coordinates()) continue;
    throw Error(fmt::format(
        "{} begins lines whose column {} is no whole number of px up to 65535; give the right order with "
        "--columns, such as txyp",
        where(), column == TextColumn::x ? "x" : "y"));
  }
}

void Decision::decide_unit() {
  const auto given = [&]() -> std::optional<int> {
    switch (options_.time_unit) {
      case TimeUnit::seconds:
        return 6;
      case TimeUnit::milliseconds:
        return 3;
      case TimeUnit::microseconds:
        return 0;
      case TimeUnit::nanoseconds:
        return -3;
      case TimeUnit::automatic:
        break;
    }
    return preamble_.time_shift;
  }();
  const ColumnStatistics& time = statistics(TextColumn::t);
  const bool has_points = time.points * 10 >= time.numbers;
  dialect_.is_unit_given = given.has_value();
  dialect_.has_time_points = dialect_.is_unit_given || has_points;
  dialect_.time_shift = given.value_or(has_points ? 6 : 0);
  if (given) return;
  note(has_points ? "times have a decimal point: taken as seconds"
                  : "times are whole numbers: taken as microseconds");
}

void Decision::decide_polarity() {
  dialect_.polarity = options_.polarity;
  if (options_.polarity != PolarityCode::automatic) return;
  const ColumnStatistics& polarity = statistics(TextColumn::p);
  dialect_.polarity = polarity.polarity();
  if (!polarity.holds_polarity()) {
    throw Error(
        fmt::format("{} begins lines whose polarities are none of 0/1, -1/1, 1/2; convert them, or check "
                    "the order of the columns (--columns)",
                    where()));
  }
  switch (dialect_.polarity) {
    case PolarityCode::zero_one:
      return note("polarity is 0/1: 1 is ON");
    case PolarityCode::minus_plus_one:
      return note("polarity is -1/1: 1 is ON");
    case PolarityCode::one_two:
      return note("polarity is 1/2: 2 is ON");
    case PolarityCode::automatic:
      return note("the first lines have polarity 1 only: taken as ON");
  }
}

}  // namespace

TextDialect decide_dialect(const ReadOptions& options, const TextPreamble& preamble,
                           std::string_view first_lines, const std::string& name, RecordingHeader& header) {
  return Decision(options, preamble, first_lines, name, header).dialect();
}

}  // namespace esi
