#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// AEDAT 3.1 of cAER. See formats.md section 3.
bool looks_like_aedat3(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_aedat3(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi
