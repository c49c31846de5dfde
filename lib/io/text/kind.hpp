#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace esi {

/// What bytes that are no text of events are, as a clause with what to do: "it is compressed with
/// gzip; unpack it first". Empty for plain text.
std::string describe_non_text(std::span<const std::byte> head);

}  // namespace esi
