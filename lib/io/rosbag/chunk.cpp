#include "esi/io/rosbag/chunk.hpp"

#include <algorithm>

namespace esi {
namespace {

constexpr std::size_t kFirstBytes = std::size_t{1} << 20;
// Of a cut frame, at most so much of what could be had is lost.
constexpr std::size_t kCutPieceBytes = 256;

}  // namespace

// The buffer grows with what comes out, not with the size that the chunk claims.
std::optional<std::span<const std::byte>> RosbagChunk::decompress(std::span<const std::byte> frame) {
  decompressor_->begin(frame);
  std::size_t size = 0;
  while (true) {
    if (size == buffer_.size()) {
      if (size >= kMaxBytes) return std::nullopt;
      buffer_.resize(std::max(kFirstBytes, 2 * size));
    }
    const auto read = decompressor_->read(std::span(buffer_).subspan(size));
    if (!read) return std::nullopt;
    size += *read;
    if (size < buffer_.size()) return std::span(buffer_).first(size);
  }
}

std::span<const std::byte> RosbagChunk::decompress_cut(std::span<const std::byte> frame) {
  decompressor_->begin(frame);
  std::size_t size = 0;
  while (size < kMaxBytes) {
    if (buffer_.size() < size + kCutPieceBytes) buffer_.resize(std::max(kFirstBytes, 2 * size));
    const auto read = decompressor_->read(std::span(buffer_).subspan(size, kCutPieceBytes));
    size += read.value_or(0);
    if (read.value_or(0) < kCutPieceBytes) break;
  }
  return std::span(buffer_).first(size);
}

}  // namespace esi
