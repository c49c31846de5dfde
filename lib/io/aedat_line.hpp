#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "esi/io/byte_window.hpp"

namespace esi {

/// Takes the next line of an AEDAT 2 or 3 header and returns it without its "\r\n". Empty where no such line
/// follows: the first byte of the data may be a '#' too, so a line counts only if it is text and ends in
/// "\r\n". Throws an Error where the file ends within a line, and beyond 16 MiB of header.
std::optional<std::string> take_aedat_line(ByteWindow& bytes);

/// What stands behind `key` in a line; empty where the line is another.
std::optional<std::string> value_in_aedat_line(const std::string& line, std::string_view key);

}  // namespace esi
