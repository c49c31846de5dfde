#include "esi/io/hdf5/dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Without filters, HDF5 then reads straight into our memory.
constexpr std::size_t kNoChunkCache = 0;

/// Throws an Error for datasets whose values lie in other files.
void refuse_other_files(hid_t creation_properties, const std::string& where) {
  const bool is_virtual = H5Pget_layout(creation_properties) == H5D_VIRTUAL;
  if (!is_virtual && H5Pget_external_count(creation_properties) <= 0) return;
  throw Error(where +
              " keeps its values in other files, which are not followed; copy it into one file with "
              "h5repack");
}

void refuse_large_chunks(const Hdf5Shape& shape, const std::string& where) {
  // In floating point, as a damaged file may claim what 64 bits can't hold.
  double bytes = static_cast<double>(shape.value_bytes);
  for (const hsize_t side : shape.chunk) bytes *= static_cast<double>(side);
  if (bytes >= 1 && bytes <= static_cast<double>(kLargestChunkBytes)) return;
  throw Error(
      fmt::format("{} has chunks of {:.0f} bytes, but at most {} can be read; write it again with "
                  "h5repack -l CHUNK=65536",
                  where, bytes, kLargestChunkBytes));
}

}  // namespace

Hdf5Dataset::Hdf5Dataset(const Hdf5File& file, const std::string& path, const Hdf5Limits& limits)
    : path_(path), where_(fmt::format("{}: dataset {}", file.name(), path)) {
  const Hdf5Lock lock;
  open(file, limits);
}

Hdf5Handle Hdf5Dataset::type() const {
  const Hdf5Lock lock;
  return Hdf5Handle(H5Dget_type(dataset_.get()));
}

void Hdf5Dataset::open(const Hdf5File& file, const Hdf5Limits& limits) {
  dataset_ = file.open_dataset(path_, kNoChunkCache);
  const Hdf5Handle properties(H5Dget_create_plist(dataset_.get()));
  refuse_other_files(properties.get(), where_);  // First: a virtual dataset opens files to tell its shape.
  read_shape(limits);
  stored_rows_ = file.size_bytes() / std::max<std::uint64_t>(shape_.row_bytes(), 1);
  const H5D_layout_t layout = H5Pget_layout(properties.get());
  if (layout == H5D_CHUNKED) return prepare_chunks(file, properties.get());
  const bool was_never_written = layout == H5D_CONTIGUOUS && H5Dget_offset(dataset_.get()) == HADDR_UNDEF;
  if (was_never_written) {
    stored_rows_ = 0;
  } else if (shape_.rows() > stored_rows_) {
    throw Error(
        fmt::format("{} declares {} rows, more than the file's {} bytes can hold; copy the file again",
                    where_, shape_.rows(), file.size_bytes()));
  }
}

void Hdf5Dataset::read_shape(const Hdf5Limits& limits) {
  const Hdf5Handle space(H5Dget_space(dataset_.get()));
  shape_.rank = H5Sget_simple_extent_ndims(space.get());
  if (shape_.rank < 0 || shape_.rank > limits.rank) {
    throw Error(fmt::format("{} has {} dimensions, but at most {} can be used here", where_, shape_.rank,
                            limits.rank));
  }
  shape_.extent[0] = shape_.rank == 0 ? 1 : 0;
  H5Sget_simple_extent_dims(space.get(), shape_.extent.data(), nullptr);
  const auto& [rows, lines, values] = shape_.extent;
  if (lines == 0 || values == 0 || lines > limits.values_per_row / values) {
    throw Error(fmt::format("{} has {} x {} values per row, but 1 to {} can be used here", where_, lines,
                            values, limits.values_per_row));
  }
  shape_.value_bytes = H5Tget_size(type().get());
}

void Hdf5Dataset::prepare_chunks(const Hdf5File& file, hid_t creation_properties) {
  H5Pget_chunk(creation_properties, shape_.rank, shape_.chunk.data());
  refuse_large_chunks(shape_, where_);
  const std::vector<Hdf5Filter> filters = filters_of(creation_properties);
  if (filters.empty()) return;
  stored_rows_ = shape_.rows();  // What is stored is compressed: the file's size bounds nothing.
  if (!ChunkDecoder::knows(filters)) {
    require_filters(filters, where_);
    // A cache of one chunk is enough to decode each once. It can be chosen only when a dataset is opened.
    dataset_ = Hdf5Handle();
    dataset_ = file.open_dataset(path_, shape_.chunk_bytes());
  }
  chunks_.emplace(dataset_.get(), creation_properties, shape_);
}

std::uint64_t Hdf5Dataset::first_gap(std::uint64_t begin, std::uint64_t end) const {
  end = std::min(end, std::max(begin, stored_rows_));
  if (shape_.chunk_rows() == 0) return end;
  const Hdf5Lock lock;
  const std::uint64_t step = shape_.chunk_rows();
  for (std::uint64_t row = begin - begin % step; row < end; row += step) {
    const Hdf5Extent offset{row, 0, 0};
    hsize_t stored_bytes = 0;
    const bool is_found = H5Dget_chunk_storage_size(dataset_.get(), offset.data(), &stored_bytes) >= 0;
    if (!is_found || stored_bytes == 0) return std::max(begin, row);
  }
  return end;
}

std::optional<std::string> Hdf5Dataset::read(std::uint64_t begin, std::uint64_t count, hid_t memory_type,
                                             void* target) {
  const Hdf5Lock lock;
  if (chunks_ && chunks_->decode_here()) return read_decoded(begin, count, memory_type, target);
  if (chunks_) {
    if (auto reason = chunks_->check(begin, count)) return reason;
  }
  return read_with_hdf5(begin, count, memory_type, target);
}

std::optional<std::string> Hdf5Dataset::read_decoded(std::uint64_t begin, std::uint64_t count,
                                                     hid_t memory_type, void* target) {
  const Hdf5Handle stored_type = type();
  const std::size_t bytes = count * shape_.row_bytes();
  if (H5Tequal(stored_type.get(), memory_type) > 0) {
    return chunks_->read(begin, count, {static_cast<std::byte*>(target), bytes});
  }
  const std::uint64_t values = count * shape_.values_per_row();
  const std::size_t converted_bytes = values * H5Tget_size(memory_type);
  unconverted_.resize(std::max(bytes, converted_bytes));  // H5Tconvert works in place.
  if (auto reason = chunks_->read(begin, count, std::span(unconverted_).first(bytes))) return reason;
  if (H5Tconvert(stored_type.get(), memory_type, values, unconverted_.data(), nullptr, H5P_DEFAULT) < 0) {
    throw Error(fmt::format("{}: its type cannot be converted ({})", where_, last_hdf5_failure().reason));
  }
  std::memcpy(target, unconverted_.data(), converted_bytes);
  return std::nullopt;
}

std::optional<std::string> Hdf5Dataset::read_with_hdf5(std::uint64_t begin, std::uint64_t count,
                                                       hid_t memory_type, void* target) {
  const Hdf5Extent start{begin, 0, 0};
  Hdf5Extent extent = shape_.extent;
  extent[0] = count;
  const Hdf5Handle file_space(H5Dget_space(dataset_.get()));
  if (shape_.rank > 0) {
    H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  }
  const Hdf5Handle memory_space(H5Screate_simple(shape_.rank, extent.data(), nullptr));
  if (H5Dread(dataset_.get(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, target) >= 0) {
    return std::nullopt;
  }
  const Hdf5Failure failure = last_hdf5_failure();
  if (failure.out_of_memory || shape_.chunk_rows() == 0) {
    throw Error(fmt::format("{}, rows {} to {}: cannot be read ({})", where_, begin, begin + count - 1,
                            failure.reason));
  }
  return failure.reason;
}

}  // namespace esi
