#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// Prophesee DAT with events (types 0 and 12). See formats.md section 7.
bool looks_like_prophesee_dat(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_prophesee_dat(std::unique_ptr<ByteSource> bytes,
                                                 const ReadOptions& options);

}  // namespace esi
