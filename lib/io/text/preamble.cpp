#include "esi/io/text/preamble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "esi/core/error.hpp"
#include "esi/io/text/numbers.hpp"

namespace esi {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kGeometry = "geometry:";

char separator_of(std::string_view line) { return line.find(',') == std::string_view::npos ? ' ' : ','; }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

TextColumn column_of(std::string_view name) {
  const auto is = [name](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is({"t", "ts", "time", "timestamp", "timestamps"})) return TextColumn::t;
  if (is({"x"})) return TextColumn::x;
  if (is({"y"})) return TextColumn::y;
  if (is({"p", "pol", "polarity", "polarities", "on"})) return TextColumn::p;
  return TextColumn::other;
}

// Takes "_us" off "t_us".
std::optional<int> take_unit(std::string& name) {
  struct Unit {
    std::string_view suffix;
    int shift;
  };
  for (const auto& [suffix, shift] : {Unit{"_us", 0}, Unit{"_ms", 3}, Unit{"_ns", -3}, Unit{"_s", 6}}) {
    if (name.size() > suffix.size() && name.ends_with(suffix)) {
      name.resize(name.size() - suffix.size());
      return shift;
    }
  }
  return std::nullopt;
}

bool is_number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);  // also nan and inf
  return split_decimal(text) || (stop == end && error == std::errc{});
}

// A line with a number in it is data, if perhaps bad data.
bool has_number(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::array<std::string_view, 32> fields;
  const std::size_t n = std::min(split_fields(line, ' ', fields), fields.size());
  return std::any_of(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(n), is_number);
}

// "346 260", "346,260" or "346x260"
std::optional<SensorSize> parse_size(std::string_view text, const std::string& where) {
  std::array<std::string_view, 3> fields;
  std::string with_commas(text);
  std::replace(with_commas.begin(), with_commas.end(), 'x', ',');
  if (split_fields(with_commas, separator_of(with_commas), fields) != 2) return std::nullopt;
  const auto width = parse_whole(fields[0]);
  const auto height = parse_whole(fields[1]);
  if (!width || !height) return std::nullopt;
  const auto is_side = [](std::int64_t side) { return side >= 1 && side <= kMaxSensorSide_px; };
  if (!is_side(*width) || !is_side(*height)) {
    throw Error(fmt::format("{} {} gives no possible sensor size: each side must be 1 to {} px; correct it",
                            where, shown(text), kMaxSensorSide_px));
  }
  return SensorSize{static_cast<int>(*width), static_cast<int>(*height)};
}

void take_comment(std::string_view line, const std::string& where, TextPreamble& preamble) {
  if (line.empty()) return;
  const std::string_view text = trimmed(line.substr(1));
  if (line.front() == '%' && text.starts_with(kGeometry)) {
    preamble.sensor = parse_size(trimmed(text.substr(kGeometry.size())), where);
    preamble.has_geometry = true;
    if (!preamble.sensor) {
      throw Error(fmt::format("{} {} is not %geometry:WIDTH,HEIGHT; correct it", where, shown(line)));
    }
  } else if (preamble.columns.empty()) {
    name_columns(text, preamble);
  }
}

// Whether the line belongs to what stands before the events.
bool take_line(std::string_view line, const std::string& where, TextPreamble& preamble) {
  if (is_comment(line)) {
    take_comment(line, where, preamble);
    return true;
  }
  if (!has_number(std::string(line))) {
    if (preamble.names_line > 0) return false;
    preamble.names = std::string(line);
    preamble.names_line = preamble.lines + 1;
    name_columns(line, preamble);
    return true;
  }
  if (preamble.sensor || preamble.names_line > 0) return false;
  preamble.sensor = parse_size(line, where);
  return preamble.sensor.has_value();
}

}  // namespace

bool name_columns(std::string_view names, TextPreamble& preamble) {
  std::array<std::string_view, 32> fields;
  const std::size_t n = split_fields(names, separator_of(names), fields);
  if (n > fields.size()) return false;
  std::vector<TextColumn> columns;
  std::array<int, 5> count{};
  std::optional<int> time_shift;
  for (std::size_t i = 0; i < n; ++i) {
    std::string name = lower(fields[i]);
    const auto shift = take_unit(name);
    columns.push_back(column_of(name));
    if (columns.back() == TextColumn::t) time_shift = shift;
    ++count[static_cast<std::size_t>(columns.back())];
  }
  if (!std::all_of(count.begin(), count.begin() + 4, [](int c) { return c == 1; })) return false;
  preamble.columns = std::move(columns);
  preamble.time_shift = time_shift;
  preamble.names = std::string(names);
  return true;
}

TextPreamble read_preamble(TextBuffer& buffer) {
  TextPreamble preamble;
  bool is_first = true;
  while (true) {
    while (buffer.lines().empty() && buffer.fill()) {
    }
    std::string_view line = buffer.lines().substr(0, buffer.lines().find('\n') + 1);
    if (buffer.lines().empty()) line = buffer.remainder();  // the text ends without '\n'
    if (is_first && line.starts_with(kByteOrderMark)) {
      line.remove_prefix(kByteOrderMark.size());
      buffer.consume(kByteOrderMark.size());
    }
    is_first = false;
    if (line.empty()) return preamble;
    const std::string where = fmt::format("{}: line {}", buffer.name(), preamble.lines + 1);
    if (!take_line(trimmed(line), where, preamble)) return preamble;
    ++preamble.lines;
    buffer.consume(line.size());
  }
}

}  // namespace esi
