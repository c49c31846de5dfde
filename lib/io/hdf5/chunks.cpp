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
  const Hdf5Extent& step = shape_.chunk;
  for (std::uint64_t row = begin - begin % step[0]; row < begin + count; row += step[0]) {
    for (std::uint64_t line = 0; line < shape_.extent[1]; line += step[1]) {
      for (std::uint64_t value = 0; value < shape_.extent[2]; value += step[2]) {
        if (auto reason = visit(Hdf5Extent{row, line, value})) return reason;
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::read(std::uint64_t begin, std::uint64_t count,
                                            std::span<std::byte> target) {
  return for_each_chunk(begin, count, [&](const Hdf5Extent& offset) {
    auto reason = load(offset);
    if (!reason) copy_rows(offset, begin, count, target);
    return reason;
  });
}

std::optional<std::string> Hdf5Chunks::check(std::uint64_t begin, std::uint64_t count) {
  const bool is_blosc = std::any_of(filters_.begin(), filters_.end(),
                                    [](const Hdf5Filter& filter) { return filter.id == kBloscFilter; });
  if (!is_blosc) return std::nullopt;
  return for_each_chunk(begin, count, [&](const Hdf5Extent& offset) { return check_blosc(offset); });
}

std::optional<std::string> Hdf5Chunks::fetch(const Hdf5Extent& offset) {
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
  bool is_cut = false;
  for (std::size_t i = 0; i < offset.size(); ++i) is_cut |= offset[i] + shape_.chunk[i] > shape_.extent[i];
  if (is_cut && edges_are_plain_) mask_ = ~std::uint32_t{0};
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::load(const Hdf5Extent& offset) {
  if (loaded_ == offset) return std::nullopt;
  loaded_.reset();
  if (auto reason = fetch(offset)) return reason;
  chunk_.resize(shape_.chunk_bytes());
  if (auto reason = decoder_.decode(stored_, mask_, chunk_)) return reason;
  loaded_ = offset;
  return std::nullopt;
}

std::optional<std::string> Hdf5Chunks::check_blosc(const Hdf5Extent& offset) {
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

void Hdf5Chunks::copy_rows(const Hdf5Extent& offset, std::uint64_t begin, std::uint64_t count,
                           std::span<std::byte> target) const {
  const auto& [chunk_rows, chunk_lines, chunk_values] = shape_.chunk;
  const std::uint64_t first = std::max<std::uint64_t>(begin, offset[0]);
  const std::uint64_t last = std::min<std::uint64_t>(begin + count, offset[0] + chunk_rows);
  const std::uint64_t line_bytes = chunk_values * shape_.value_bytes;
  const std::uint64_t stride = chunk_lines * line_bytes;
  const std::uint64_t lines = std::min<std::uint64_t>(chunk_lines, shape_.extent[1] - offset[1]);
  const std::uint64_t values = std::min<std::uint64_t>(chunk_values, shape_.extent[2] - offset[2]);
  // Whole lines lie behind each other in both.
  const bool is_whole = chunk_values == shape_.extent[2];
  const std::uint64_t pieces = is_whole ? 1 : lines;
  const std::uint64_t piece = (is_whole ? lines : 1) * values * shape_.value_bytes;
  const std::byte* from = chunk_.data() + (first - offset[0]) * stride;
  std::byte* to = target.data() + (first - begin) * shape_.row_bytes() +
                  (offset[1] * shape_.extent[2] + offset[2]) * shape_.value_bytes;
  if (piece == stride && piece == shape_.row_bytes()) {
    std::memcpy(to, from, (last - first) * piece);
    return;
  }
  for (std::uint64_t row = first; row < last; ++row, from += stride, to += shape_.row_bytes()) {
    for (std::uint64_t k = 0; k < pieces; ++k) {
      std::memcpy(to + k * shape_.extent[2] * shape_.value_bytes, from + k * line_bytes, piece);
    }
  }
}

}  // namespace esi
