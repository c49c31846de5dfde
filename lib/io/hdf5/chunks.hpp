#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "esi/io/hdf5/chunk_decoder.hpp"

namespace esi {

inline constexpr int kMostHdf5Dimensions = 3;
using Hdf5Extent = std::array<hsize_t, kMostHdf5Dimensions>;

/// A dataset's extent; a scalar counts as one row of one value.
struct Hdf5Shape {
  int rank = 0;
  Hdf5Extent extent{0, 1, 1};  ///< rows first; 1 in every dimension beyond the rank
  Hdf5Extent chunk{0, 1, 1};   ///< no rows where there are no chunks
  std::uint64_t value_bytes = 0;

  std::uint64_t rows() const { return extent[0]; }
  std::uint64_t chunk_rows() const { return chunk[0]; }
  std::uint64_t values_per_row() const { return extent[1] * extent[2]; }
  std::uint64_t row_bytes() const { return values_per_row() * value_bytes; }
  std::uint64_t chunk_bytes() const { return chunk[0] * chunk[1] * chunk[2] * value_bytes; }
};

/// The filtered chunks of one dataset. All calls need Hdf5Lock; the dataset must outlive this.
class Hdf5Chunks {
 public:
  Hdf5Chunks(hid_t dataset, hid_t creation_properties, const Hdf5Shape& shape);

  /// Whether `read` works; else a plugin is needed, and HDF5 has to read.
  bool decode_here() const { return decode_here_; }

  /// Reads rows [begin, begin + count) as they are stored. Nothing when it worked, else the reason. Each
  /// chunk is decoded once when rows are read in order.
  std::optional<std::string> read(std::uint64_t begin, std::uint64_t count, std::span<std::byte> target);

  /// Why HDF5 should not be asked for these rows: a Blosc chunk that decodes to another size than it must.
  std::optional<std::string> check(std::uint64_t begin, std::uint64_t count);

 private:
  std::optional<std::string> fetch(const Hdf5Extent& offset);
  std::optional<std::string> load(const Hdf5Extent& offset);
  std::optional<std::string> check_blosc(const Hdf5Extent& offset);
  void copy_rows(const Hdf5Extent& offset, std::uint64_t begin, std::uint64_t count,
                 std::span<std::byte> target) const;
  template <class Visit>
  std::optional<std::string> for_each_chunk(std::uint64_t begin, std::uint64_t count, Visit visit);

  hid_t dataset_;
  Hdf5Shape shape_;
  std::vector<Hdf5Filter> filters_;
  bool decode_here_ = false;
  bool edges_are_plain_ = false;  ///< chunks that the dataset's end cuts went through no filter
  ChunkDecoder decoder_;
  std::vector<std::byte> stored_, chunk_;  ///< reused
  std::uint32_t mask_ = 0;                 ///< of `stored_`: bit i says that filter i was left out
  std::optional<Hdf5Extent> loaded_;       ///< which chunk is in `chunk_`
};

}  // namespace esi
