#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/io/hdf5/filters.hpp"

namespace esi {

/// Undoes the filters that need no plugin: gzip, LZF, shuffle and the checksum. HDF5's own way of doing this
/// takes whatever memory a damaged chunk asks for, and reads behind the end of a chunk that decodes to too
/// little.
class ChunkDecoder {
 public:
  explicit ChunkDecoder(std::vector<Hdf5Filter> filters) : filters_(std::move(filters)) {}

  /// Whether all filters are among those.
  static bool knows(std::span<const Hdf5Filter> filters);

  /// Fills `chunk`. Bit i of `mask` says that filter i was left out. Nothing when it worked, else the reason.
  std::optional<std::string> decode(std::span<const std::byte> stored, std::uint32_t mask,
                                    std::span<std::byte> chunk);

 private:
  std::vector<Hdf5Filter> filters_;
  std::vector<std::byte> source_, target_;  ///< reused
};

}  // namespace esi
