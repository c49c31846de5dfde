#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// AEDAT 2.0 of jAER. See formats.md section 2.
bool looks_like_aedat2(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_aedat2(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi
