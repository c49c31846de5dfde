#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "esi/core/event.hpp"
#include "esi/io/text/clock.hpp"
#include "esi/io/text/line.hpp"

namespace esi {

/// The plain form that nearly all lines of nearly all recordings have: up to 32 characters, columns t x y p
/// or x y p t with one separator between them, no sign but one before p, polarity of one digit, '\n' or
/// "\r\n" at the end.
struct FastLayout {
  bool is_time_last = false;
  bool is_seconds = false;  ///< times with a point and at least one digit behind it; else whole us
  char separator = ' ';
  PolarityCode polarity = PolarityCode::zero_one;  ///< automatic: only 1 is known
  bool has_carriage_returns = false;
};

/// Nothing where the dialect's plain lines are of another form.
std::optional<FastLayout> fast_layout(const TextDialect& dialect);

struct FastLines {
  std::size_t events = 0;  ///< one a line
  std::size_t bytes = 0;
};

/// Reads plain lines into `target`, as many as fit, and stops at the first line that is not plain or whose
/// time does not rise by a plain step of `clock` (which must have started). Takes whole lines only; up to
/// TextBuffer::kMargin bytes around `lines` are loaded but not used.
FastLines read_fast(const FastLayout& layout, std::string_view lines, TextClock& clock,
                    std::span<Event> target);

}  // namespace esi
