#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "esi/io/decompress.hpp"

namespace esi {

/// Decompresses a bag's LZ4 chunks into a buffer that is used again and again.
class RosbagChunk {
 public:
  /// No compressed chunk may be larger, before or after, whatever it claims: rosbag's own have 768 KiB.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

  RosbagChunk() : decompressor_(make_decompressor(Codec::lz4)) {}

  /// The records of a whole frame; valid until the next call. Empty when it is corrupt or too large.
  std::optional<std::span<const std::byte>> decompress(std::span<const std::byte> frame);

  /// What can be had of a frame that the file's end cuts.
  std::span<const std::byte> decompress_cut(std::span<const std::byte> frame);

 private:
  std::unique_ptr<Decompressor> decompressor_;
  std::vector<std::byte> buffer_;
};

}  // namespace esi
