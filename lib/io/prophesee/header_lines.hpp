#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/io/byte_window.hpp"

namespace esi {

/// The lines "% key value" that Prophesee's RAW and DAT files begin with. Nothing need mark their end, and
/// the data may begin with '%' too: a line counts only if it is text up to its line feed.
struct PropheseeHeaderLines {
  struct Line {
    std::string_view key;    ///< the first word
    std::string_view value;  ///< the rest, without blanks around it
  };

  std::vector<Line> lines;   ///< views of the bytes that were parsed
  std::size_t bytes = 0;     ///< where the data begin
  bool is_complete = false;  ///< whether what comes next is known not to be a further line

  static PropheseeHeaderLines in(std::span<const std::byte> head);

  /// The first line's value with that key.
  std::optional<std::string_view> find(std::string_view key) const;
};

/// Looks at as much of a file's beginning as its lines need, 1 MiB at most, and takes nothing. The result is
/// valid until the next call on `bytes`.
PropheseeHeaderLines peek_prophesee_header(ByteWindow& bytes);

/// A sensor's size of two whole numbers; empty where they can't be one.
std::optional<SensorSize> sensor_size_from(std::string_view width, std::string_view height);

/// Text from a file, short enough for a message.
std::string_view shortened(std::string_view text);

}  // namespace esi
