#include "esi/io/text/line.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "esi/io/text/numbers.hpp"

namespace esi {
namespace {

constexpr std::size_t kMaxColumns = 32;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::size_t split_at_commas(std::string_view line, std::span<std::string_view> fields) {
  std::size_t n = 0;
  while (true) {
    const std::size_t comma = line.find(',');
    if (n < fields.size()) fields[n] = trimmed(line.substr(0, comma));
    ++n;
    if (comma == std::string_view::npos) return n;
    line.remove_prefix(comma + 1);
  }
}

std::size_t split_at_blanks(std::string_view line, std::span<std::string_view> fields) {
  std::size_t n = 0;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at != end) {
    const char* const stop = std::find_if(at, end, is_blank);
    if (n < fields.size()) fields[n] = {at, static_cast<std::size_t>(stop - at)};
    ++n;
    at = std::find_if_not(stop, end, is_blank);
  }
  return n;
}

std::optional<std::int64_t> parse_time(std::string_view text, const TextDialect& dialect) {
  const auto number = split_decimal(text);
  if (!number || (number->has_point && !dialect.has_time_points)) return std::nullopt;
  const auto time = scaled(*number, dialect.time_shift);
  if (!time) return std::nullopt;
  return time->value;
}

std::optional<bool> decode_polarity(std::int64_t value, PolarityCode& code) {
  if (code == PolarityCode::automatic && value == 0) code = PolarityCode::zero_one;
  if (code == PolarityCode::automatic && value == -1) code = PolarityCode::minus_plus_one;
  const std::int64_t on = code == PolarityCode::one_two ? 2 : 1;
  const std::int64_t off = code == PolarityCode::one_two ? 1 : code == PolarityCode::minus_plus_one ? -1 : 0;
  if (value == on) return true;
  if (value == off) return false;
  return std::nullopt;
}

std::string_view polarity_problem(PolarityCode code) {
  switch (code) {
    case PolarityCode::zero_one:
      return "its polarity is neither 0 nor 1";
    case PolarityCode::minus_plus_one:
      return "its polarity is neither -1 nor 1";
    case PolarityCode::one_two:
      return "its polarity is neither 1 nor 2";
    case PolarityCode::automatic:
      break;
  }
  return "its polarity is not 1 like all before; if 1 is OFF and 2 is ON, give --polarity 1/2";
}

bool fits_16_bits(std::int64_t value) {
  return value >= 0 && value <= std::numeric_limits<std::uint16_t>::max();
}

TextLine unreadable(std::string_view problem) { return {TextLine::Kind::unreadable, {}, problem}; }

// The numbers of one line, in the order t, x, y, p.
TextLine interpret(const std::array<std::string_view, 4>& values, TextDialect& dialect) {
  const auto t_us = parse_time(values[0], dialect);
  if (!t_us) {
    return unreadable(dialect.has_time_points ? "its time is not a number in range"
                                              : "its time is not a whole number (of microseconds, unless "
                                                "--time-unit says otherwise)");
  }
  const auto x = parse_whole(values[1]);
  const auto y = parse_whole(values[2]);
  if (!x || !y) return unreadable("a coordinate is not a whole number");
  const auto p = parse_whole(values[3]);
  if (!p) return unreadable("its polarity is not a whole number");
  const auto on = decode_polarity(*p, dialect.polarity);
  if (!on) return unreadable(polarity_problem(dialect.polarity));

  if (!fits_16_bits(*x) || !fits_16_bits(*y)) return {TextLine::Kind::outside_16_bits, {}, {}};
  const Event event{*t_us, static_cast<std::uint16_t>(*x), static_cast<std::uint16_t>(*y), *on};
  return {TextLine::Kind::event, event, {}};
}

}  // namespace

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

bool is_comment(std::string_view line) { return line.empty() || line.front() == '#' || line.front() == '%'; }

std::size_t split_fields(std::string_view line, char separator, std::span<std::string_view> fields) {
  return separator == ',' ? split_at_commas(line, fields) : split_at_blanks(line, fields);
}

std::string shown(std::string_view line) {
  constexpr std::size_t kMaxShown = 40;
  line = trimmed(line);
  std::string text(line.substr(0, kMaxShown));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (line.size() > kMaxShown ? "...'" : "'");
}

TextLine parse_line(std::string_view line, TextDialect& dialect) {
  line = trimmed(line);
  if (is_comment(line)) return {TextLine::Kind::comment, {}, {}};
  std::array<std::string_view, kMaxColumns> fields;
  if (split_fields(line, dialect.separator, fields) != dialect.columns.size()) {
    return unreadable("it has another number of columns");
  }
  std::array<std::string_view, 4> values;
  for (std::size_t i = 0; i < dialect.columns.size(); ++i) {
    const auto column = static_cast<std::size_t>(dialect.columns[i]);
    if (column < values.size()) values[column] = fields[i];
  }
  return interpret(values, dialect);
}

}  // namespace esi
