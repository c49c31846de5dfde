#include "esi/io/hdf5/chunks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "esi/io/hdf5/handle.hpp"

namespace esi {
namespace {

/// A chunk that would not shrink is a little longer than what it holds: headers, checksums.
constexpr std::uint64_t kSlackBytes = std::uint64_t{1} << 16;

}  // namespace

Hdf5Chunks::Hdf5Chunks(hid_t dataset, hid_t creation_properties, const Hdf5Shape& shape)
    : dataset_(dataset),
      shape_(shape),
      filters_(filters_of(creation_properties)),
      decode_here_(ChunkDecoder::knows(filters_)),
      decoder_(filters_) {
  unsigned options = 0;
  H5Pget_chunk_opts(creation_properties, &options);
  edges_are_plain_ = (options & H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS) != 0;
}

template <class Visit>
std::optional<std::string> Hdf5Chunks::for_each_chunk(std::uint64_t begin, std::uint64_t count, Visit visit) {
  for (std::uint64_t row = begin - begin % shape_.chunk_rows; row < begin + count; row += shape_.chunk_rows) {
    for (std::uint64_t value = 0; value < shape_.values_per_row; value += shape_.chunk_values) {
      if (auto reason = visit(Offset{row, value})) return reason;
    }
  }
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::read(std::uint64_t begin, std::uint64_t count,
                                            std::span<std::byte> target) {
  return for_each_chunk(begin, count, [&](const Offset& offset) {
    auto reason = load(offset);
    if (!reason) copy_rows(offset, begin, count, target);
    return reason;
  });
}

std::optional<std::string> Hdf5Chunks::check(std::uint64_t begin, std::uint64_t count) {
  const bool is_blosc = std::any_of(filters_.begin(), filters_.end(),
                                    [](const Hdf5Filter& filter) { return filter.id == kBloscFilter; });
  if (!is_blosc) return std::nullopt;
  return for_each_chunk(begin, count, [&](const Offset& offset) { return check_blosc(offset); });
}

std::optional<std::string> Hdf5Chunks::fetch(const Offset& offset) {
  hsize_t stored_bytes = 0;
  if (H5Dget_chunk_storage_size(dataset_, offset.data(), &stored_bytes) < 0)
    return last_hdf5_failure().reason;
  if (stored_bytes > 2 * shape_.chunk_bytes() + kSlackBytes) {
    return fmt::format("a chunk for {} bytes takes {}", shape_.chunk_bytes(), stored_bytes);
  }
  stored_.resize(stored_bytes);
  if (H5Dread_chunk(dataset_, H5P_DEFAULT, offset.data(), &mask_, stored_.data()) < 0) {
    return last_hdf5_failure().reason;
  }
  const bool is_cut =
      offset[0] + shape_.chunk_rows > shape_.rows || offset[1] + shape_.chunk_values > shape_.values_per_row;
  if (is_cut && edges_are_plain_) mask_ = ~std::uint32_t{0};
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::load(const Offset& offset) {
  if (loaded_ == offset) return std::nullopt;
  loaded_.reset();
  if (auto reason = fetch(offset)) return reason;
  chunk_.resize(shape_.chunk_bytes());
  if (auto reason = decoder_.decode(stored_, mask_, chunk_)) return reason;
  loaded_ = offset;
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::check_blosc(const Offset& offset) {
  if (auto reason = fetch(offset)) return reason;
  const auto blosc = std::find_if(filters_.begin(), filters_.end(),
                                  [](const Hdf5Filter& filter) { return filter.id == kBloscFilter; });
  const auto bit = static_cast<unsigned>(blosc - filters_.begin());
  const bool is_plain = (mask_ >> bit & 1) != 0;
  // Bytes 4 to 7 of Blosc's header, little endian, say what it decodes to.
  std::uint64_t size = is_plain ? stored_.size() : 0;
  for (std::size_t i = 8; i-- > 4 && !is_plain && stored_.size() >= 8;) {
    size = size << 8 | std::to_integer<std::uint64_t>(stored_[i]);
  }
  if (size >= shape_.chunk_bytes() && size <= shape_.chunk_bytes() + kSlackBytes) return std::nullopt;
  return fmt::format("the chunk decodes to {} bytes instead of {}", size, shape_.chunk_bytes());
}

void Hdf5Chunks::copy_rows(const Offset& offset, std::uint64_t begin, std::uint64_t count,
                           std::span<std::byte> target) const {
  const std::uint64_t row_0 = offset[0];
  const std::uint64_t value_0 = offset[1];
  const std::uint64_t first = std::max(begin, row_0);
  const std::uint64_t last = std::min(begin + count, row_0 + shape_.chunk_rows);
  const std::uint64_t stride = shape_.chunk_values * shape_.value_bytes;
  const std::uint64_t piece =
      std::min(shape_.chunk_values, shape_.values_per_row - value_0) * shape_.value_bytes;
  const std::byte* from = chunk_.data() + (first - row_0) * stride;
  std::byte* to = target.data() + (first - begin) * shape_.row_bytes() + value_0 * shape_.value_bytes;
  if (piece == stride && piece == shape_.row_bytes()) {
    std::memcpy(to, from, (last - first) * piece);
    return;
  }
  for (std::uint64_t row = first; row < last; ++row, from += stride, to += shape_.row_bytes()) {
    std::memcpy(to, from, piece);
  }
}

}  // namespace esi
