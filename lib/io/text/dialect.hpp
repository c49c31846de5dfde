#pragma once

#include <string>
#include <string_view>

#include "esi/io/format_reader.hpp"
#include "esi/io/text/line.hpp"
#include "esi/io/text/preamble.hpp"

namespace esi {

/// Decides how a text recording is to be read: from the options, what stands before the first event, and its
/// first lines. Says in `header` what was found and what was assumed.
/// Throws an Error with the line where the first line is not one of an event, the columns can't be told, or
/// the options don't fit.
TextDialect decide_dialect(const ReadOptions& options, const TextPreamble& preamble,
                           std::string_view first_lines, const std::string& name, RecordingHeader& header);

}  // namespace esi
