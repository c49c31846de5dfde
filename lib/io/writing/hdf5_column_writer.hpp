#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "esi/io/hdf5/handle.hpp"
#include "esi/io/writing/hdf5_output.hpp"

namespace esi {

/// One column of unsigned integers in an HDF5 file, written value by value: chunks of 64 Ki, shuffled and
/// deflated, which every HDF5 reads without plugins.
template <class Value>
class Hdf5ColumnWriter {
 public:
  static constexpr std::size_t kChunkRows = std::size_t{1} << 16;

  /// `path` is absolute; groups that lead to it are made. `output` must live longer.
  Hdf5ColumnWriter(Hdf5Output& output, const std::string& path);

  void push(Value value) {
    chunk_.push_back(value);
    if (chunk_.size() == kChunkRows) flush();
  }

  std::uint64_t rows() const { return written_rows_ + chunk_.size(); }

  /// Writes what is still here. Nothing can be pushed after it.
  void finish();

 private:
  void flush();

  Hdf5Output* output_;
  Hdf5Handle dataset_;
  std::vector<Value> chunk_;
  std::uint64_t written_rows_ = 0;
};

extern template class Hdf5ColumnWriter<std::uint8_t>;
extern template class Hdf5ColumnWriter<std::uint16_t>;
extern template class Hdf5ColumnWriter<std::uint64_t>;

/// One signed 64-bit number.
void write_hdf5_scalar(Hdf5Output& output, const std::string& path, std::int64_t value);

}  // namespace esi
