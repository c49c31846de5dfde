#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace esi {

/// The bytes as one frame of LZ4's standard frame format, without content size and checksums.
std::vector<std::byte> lz4_frame(std::span<const std::byte> bytes);

}  // namespace esi
