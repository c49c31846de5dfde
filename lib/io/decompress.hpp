#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace esi {

enum class Codec { none, lz4, zstd };

/// Decodes whole frames of a compression format (LZ4's and zstd's standard frame formats), piece by piece:
/// never more comes out than is asked for, whatever the frame would expand to. Reusable frame after frame.
class Decompressor {
 public:
  virtual ~Decompressor() = default;

  /// Starts with a frame, which must stay where it is until it is read.
  virtual void begin(std::span<const std::byte> frame) = 0;

  /// Fills `target` from the front; returns how many bytes, which is less than its size only at the frame's
  /// end. Empty when the frame is corrupt or cut.
  virtual std::optional<std::size_t> read(std::span<std::byte> target) = 0;
};

std::unique_ptr<Decompressor> make_decompressor(Codec codec);

}  // namespace esi
