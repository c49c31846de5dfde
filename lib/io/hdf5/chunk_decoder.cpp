#include "esi/io/hdf5/chunk_decoder.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>

#include "esi/io/hdf5/lzf.hpp"

namespace esi {
namespace {

using Bytes = std::span<const std::byte>;
constexpr std::size_t kChecksumBytes = 4;

std::optional<std::size_t> inflate_chunk(Bytes stored, std::span<std::byte> target, unsigned /*level*/) {
  uLongf size = target.size();
  const int status = uncompress(reinterpret_cast<Bytef*>(target.data()), &size,
                                reinterpret_cast<const Bytef*>(stored.data()), stored.size());
  if (status != Z_OK) return std::nullopt;
  return size;
}

std::optional<std::size_t> decode_lzf_chunk(Bytes stored, std::span<std::byte> target, unsigned /*version*/) {
  return decode_lzf(stored, target);
}

/// The first bytes of all values, then the second bytes, and so on; what is left over stays as it is.
std::optional<std::size_t> unshuffle(Bytes stored, std::span<std::byte> target, unsigned value_bytes) {
  if (stored.size() > target.size() || value_bytes == 0) return std::nullopt;
  const std::size_t values = stored.size() / value_bytes;
  for (std::size_t k = 0; k < value_bytes; ++k) {
    const Bytes plane = stored.subspan(k * values, values);
    for (std::size_t i = 0; i < values; ++i) target[i * value_bytes + k] = plane[i];
  }
  std::copy(stored.begin() + static_cast<std::ptrdiff_t>(values * value_bytes), stored.end(),
            target.begin() + static_cast<std::ptrdiff_t>(values * value_bytes));
  return stored.size();
}

/// Fletcher's checksum over 16-bit big-endian words, the last one filled up with a zero byte.
std::uint32_t fletcher32(Bytes bytes) {
  std::uint64_t sum = 0;
  std::uint64_t sum_of_sums = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const auto low = i + 1 < bytes.size() ? std::to_integer<std::uint64_t>(bytes[i + 1]) : 0;
    sum = (sum + (std::to_integer<std::uint64_t>(bytes[i]) << 8 | low)) % 65535;
    sum_of_sums = (sum_of_sums + sum) % 65535;
  }
  return static_cast<std::uint32_t>(sum_of_sums << 16 | sum);
}

/// The checksum stands behind the data, little endian.
std::optional<std::size_t> take_off_checksum(Bytes stored, std::span<std::byte> target, unsigned /*none*/) {
  if (stored.size() < kChecksumBytes || stored.size() - kChecksumBytes > target.size()) return std::nullopt;
  const Bytes data = stored.first(stored.size() - kChecksumBytes);
  std::uint32_t checksum = 0;
  for (std::size_t i = kChecksumBytes; i-- > 0;) {
    checksum = checksum << 8 | std::to_integer<std::uint32_t>(stored[data.size() + i]);
  }
  if (checksum != fletcher32(data)) return std::nullopt;
  std::copy(data.begin(), data.end(), target.begin());
  return data.size();
}

struct Undoing {
  H5Z_filter_t id;
  std::string_view name;
  /// Returns how many bytes were written; nothing where the data is broken or does not fit.
  std::optional<std::size_t> (*undo)(Bytes stored, std::span<std::byte> target, unsigned parameter);
};

constexpr std::array kUndoings = {
    Undoing{H5Z_FILTER_DEFLATE, "gzip", inflate_chunk},
    Undoing{kLzfFilter, "LZF", decode_lzf_chunk},
    Undoing{H5Z_FILTER_SHUFFLE, "shuffle", unshuffle},
    Undoing{H5Z_FILTER_FLETCHER32, "checksum", take_off_checksum},
};

const Undoing* find(H5Z_filter_t id) {
  const auto* const found = std::find_if(kUndoings.begin(), kUndoings.end(),
                                         [id](const Undoing& undoing) { return undoing.id == id; });
  return found == kUndoings.end() ? nullptr : found;
}

}  // namespace

bool ChunkDecoder::knows(std::span<const Hdf5Filter> filters) {
  return std::all_of(filters.begin(), filters.end(),
                     [](const Hdf5Filter& filter) { return find(filter.id) != nullptr; });
}

std::optional<std::string> ChunkDecoder::decode(Bytes stored, std::uint32_t mask,
                                                std::span<std::byte> chunk) {
  const std::size_t capacity = chunk.size() + kChecksumBytes * filters_.size();
  Bytes data = stored;
  for (std::size_t i = filters_.size(); i-- > 0;) {
    if ((mask >> i & 1) != 0) continue;
    const Undoing& undoing = *find(filters_[i].id);
    target_.resize(capacity);
    const auto size = undoing.undo(data, target_, filters_[i].parameter);
    if (!size) return fmt::format("{}: the chunk is damaged", undoing.name);
    std::swap(source_, target_);
    data = Bytes(source_).first(*size);
  }
  if (data.size() != chunk.size()) {
    return fmt::format("the chunk decodes to {} bytes instead of {}", data.size(), chunk.size());
  }
  std::copy(data.begin(), data.end(), chunk.begin());
  return std::nullopt;
}

}  // namespace esi
