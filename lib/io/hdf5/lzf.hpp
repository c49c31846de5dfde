#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace esi {

/// LZF, h5py's own compression. HDF5 does not have it, and Debian 12's hdf5-plugin-lzf does not load (it
/// lacks the symbol lzf_decompress), so it is decoded here. Returns how many bytes were written; nothing
/// where the data is broken or more than the target holds.
std::optional<std::size_t> decode_lzf(std::span<const std::byte> stored, std::span<std::byte> target);

}  // namespace esi
