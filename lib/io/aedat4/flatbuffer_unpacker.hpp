#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "esi/io/decompress.hpp"

namespace esi {

/// Decompresses FlatBuffers that begin with their own size, into a buffer that is used again and again.
class FlatbufferUnpacker {
 public:
  /// No FlatBuffer may be larger, whatever it claims: 16 million events.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

  explicit FlatbufferUnpacker(Codec codec) : decompressor_(make_decompressor(codec)) {}

  /// The FlatBuffer with its size in front, at an address fit for 8-byte numbers; valid until the next call.
  /// Empty when the frame is corrupt, cut, holds more or fewer bytes than it claims, or too many.
  std::optional<std::span<const std::byte>> unpack(std::span<const std::byte> frame);

 private:
  std::unique_ptr<Decompressor> decompressor_;
  std::vector<std::byte> buffer_;
};

}  // namespace esi
