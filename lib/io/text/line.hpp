#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/read_options.hpp"

namespace esi {

/// What a column of a text recording holds.
enum class TextColumn : std::uint8_t { t, x, y, p, other };

/// How the lines of one text recording are to be read.
struct TextDialect {
  char separator = ' ';  ///< ',' or, for any run of blanks and tabs, the first of them seen
  std::vector<TextColumn> columns;
  bool has_carriage_returns = false;
  int time_shift = 0;            ///< a time times 10^time_shift is in us
  bool is_unit_given = false;    ///< by an option or the name of a column, so that it need not be plausible
  bool has_time_points = false;  ///< whether times may be written with a decimal point
  /// automatic as long as only 1 was seen, which is ON in both codes that may still turn out.
  PolarityCode polarity = PolarityCode::automatic;
};

/// The line without blanks, tabs and carriage return at its ends.
std::string_view trimmed(std::string_view line);

/// Whether a trimmed line carries no data: it is empty, or begins with '#' or '%'.
bool is_comment(std::string_view line);

/// Cuts a trimmed line at commas, or at runs of blanks and tabs. Returns how many fields there are, which may
/// be more than `fields` holds.
std::size_t split_fields(std::string_view line, char separator, std::span<std::string_view> fields);

/// The beginning of a line, fit for a message: in quotes, printable, at most 40 characters.
std::string shown(std::string_view line);

struct TextLine {
  enum class Kind { event, comment, outside_16_bits, unreadable };
  Kind kind = Kind::unreadable;
  Event event{};             ///< t_us as written, without wraps
  std::string_view problem;  ///< of an unreadable line: "its time is not a number"
};

/// Reads any line, with or without its line end. Settles a polarity code that is still automatic.
TextLine parse_line(std::string_view line, TextDialect& dialect);

}  // namespace esi
