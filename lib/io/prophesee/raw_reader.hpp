#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// Prophesee RAW with EVT2, EVT2.1 or EVT3. See formats.md section 6.
bool looks_like_prophesee_raw(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_prophesee_raw(std::unique_ptr<ByteSource> bytes,
                                                 const ReadOptions& options);

}  // namespace esi
