#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "esi/core/packet.hpp"
#include "esi/io/losses.hpp"

namespace esi {

/// The events of an HDF5 file as rows, whichever datasets, types and units its layout keeps them in.
class Hdf5EventTable {
 public:
  virtual ~Hdf5EventTable() = default;

  virtual std::uint64_t rows() const = 0;
  /// Rows that are decoded together; 0 where there are no chunks.
  virtual std::uint64_t chunk_rows() const = 0;

  /// The first row of [begin, end) that is declared but stored nowhere; `end` where all are stored.
  virtual std::uint64_t first_gap(std::uint64_t begin, std::uint64_t end) const = 0;

  /// Reads rows [begin, begin + count) into memory, in place of those read before. Nothing when it worked,
  /// else where and why these rows cannot be decoded. Throws an Error where going on makes no sense.
  virtual std::optional<std::string> load(std::uint64_t begin, std::uint64_t count) = 0;

  /// Appends `count` events, from the loaded row `first` on. Throws an Error for a time that does not fit.
  virtual void append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) = 0;
};

}  // namespace esi
