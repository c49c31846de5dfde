#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// AEDAT 4.0 of DV and dv-processing. See formats.md section 1.
bool looks_like_aedat4(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_aedat4(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi
