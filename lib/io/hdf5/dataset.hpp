#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/io/hdf5/chunks.hpp"
#include "esi/io/hdf5/file.hpp"

namespace esi {

/// A chunk is decoded as a whole, so its size bounds the memory that reading takes.
inline constexpr std::uint64_t kLargestChunkBytes = std::uint64_t{1} << 26;

/// What a dataset may be at most: it bounds the memory that one row takes.
struct Hdf5Limits {
  int rank = 2;
  std::uint64_t values_per_row = 16;
};

/// One dataset of at most three dimensions, read by rows (the first dimension), whatever its type. A scalar
/// is one row.
class Hdf5Dataset {
 public:
  /// Throws an Error where the dataset is absent, has is beyond the limits, keeps its data in another file,
  /// or has chunks that cannot be decoded here or only with absurd memory.
  Hdf5Dataset(const Hdf5File& file, const std::string& path, const Hdf5Limits& limits = {});

  const std::string& path() const { return path_; }
  /// "FILE: dataset /events/x": how messages begin.
  const std::string& where() const { return where_; }
  const Hdf5Shape& shape() const { return shape_; }
  std::uint64_t rows() const { return shape_.rows(); }
  Hdf5Handle type() const;

  /// The first row of [begin, end) that is declared but stored nowhere; `end` where all are stored.
  std::uint64_t first_gap(std::uint64_t begin, std::uint64_t end) const;

  /// Reads rows [begin, begin + count) into `target`, converted to `memory_type`. Nothing when it worked,
  /// else why these rows cannot be decoded. Throws an Error where going on makes no sense: the rows are not
  /// in chunks, or memory ran out.
  std::optional<std::string> read(std::uint64_t begin, std::uint64_t count, hid_t memory_type, void* target);

 private:
  void open(const Hdf5File& file, const Hdf5Limits& limits);
  void read_shape(const Hdf5Limits& limits);
  void prepare_chunks(const Hdf5File& file, hid_t creation_properties);
  std::optional<std::string> read_decoded(std::uint64_t begin, std::uint64_t count, hid_t memory_type,
                                          void* target);
  std::optional<std::string> read_with_hdf5(std::uint64_t begin, std::uint64_t count, hid_t memory_type,
                                            void* target);

  std::string path_, where_;
  Hdf5Handle dataset_;
  Hdf5Shape shape_;
  std::uint64_t stored_rows_ = 0;       ///< an upper bound
  std::optional<Hdf5Chunks> chunks_;    ///< where there are filters
  std::vector<std::byte> unconverted_;  ///< reused
};

}  // namespace esi
