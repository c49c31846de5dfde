#include "esi/io/aedat4/flatbuffer_unpacker.hpp"

#include <flatbuffers/flatbuffers.h>

namespace esi {
namespace {

// A packet of 10 ms mostly fits. Only after so many bytes is the size that a FlatBuffer claims believed, so
// that a small damaged frame can't have a large buffer allocated or filled.
constexpr std::size_t kFirstBytes = std::size_t{1} << 18;

std::size_t claimed_size(std::span<const std::byte> buffer) {
  return sizeof(flatbuffers::uoffset_t) + flatbuffers::ReadScalar<flatbuffers::uoffset_t>(buffer.data());
}

}  // namespace

std::optional<std::span<const std::byte>> FlatbufferUnpacker::unpack(std::span<const std::byte> frame) {
  if (buffer_.empty()) buffer_.resize(kFirstBytes);
  decompressor_->begin(frame);
  const auto first = decompressor_->read(std::span(buffer_).first(kFirstBytes));
  if (!first || *first < sizeof(flatbuffers::uoffset_t)) return std::nullopt;
  const std::size_t size = claimed_size(buffer_);
  if (size > kMaxBytes) return std::nullopt;

  std::size_t unpacked = *first;
  if (unpacked == kFirstBytes && size >= kFirstBytes) {
    // One byte more than claimed shows whether the frame ends where it should.
    if (buffer_.size() <= size) buffer_.resize(size + 1);
    const auto rest = decompressor_->read(std::span(buffer_).subspan(kFirstBytes, size + 1 - kFirstBytes));
    if (!rest) return std::nullopt;
    unpacked += *rest;
  }
  if (unpacked != size) return std::nullopt;
  return std::span(buffer_).first(size);
}

}  // namespace esi
