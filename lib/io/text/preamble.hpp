#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/text/buffer.hpp"
#include "esi/io/text/line.hpp"

namespace esi {

/// What stands before the first event of a text recording.
struct TextPreamble {
  std::int64_t lines = 0;
  std::optional<SensorSize> sensor;  ///< of "%geometry:W,H" or a first line "W H"
  bool has_geometry = false;         ///< "%geometry:" was there, which only Metavision writes
  std::vector<TextColumn> columns;   ///< of a line that names them; empty without one
  std::optional<int> time_shift;     ///< of a named unit, such as in "t_us": 10^shift us
  std::string names;                 ///< the line of names, as it stands; known ones or not
  std::int64_t names_line = 0;       ///< its number; 0 where a comment names the columns, or nothing does
};

/// Takes byte order mark, comments, sensor size and names of columns out of the buffer, up to the first line
/// that has numbers. Throws an Error with the line for a sensor size that can't be.
TextPreamble read_preamble(TextBuffer& buffer);

/// The columns that names such as "x,y,polarity,timestamp_us" stand for.
/// False, with `preamble` unchanged, where they don't name each of t, x, y, p once.
bool name_columns(std::string_view names, TextPreamble& preamble);

}  // namespace esi
