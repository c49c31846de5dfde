#pragma once

#include <array>
#include <string>
#include <vector>

#include "esi/io/hdf5/column.hpp"
#include "esi/io/hdf5/event_rows.hpp"
#include "esi/io/hdf5/event_table.hpp"

namespace esi {

/// Where the four columns of a file are, and what their times are.
struct Hdf5ColumnPaths {
  std::string x, y, t, p;
  TimeColumn time = TimeColumn::microseconds;
};

/// Events as four datasets x, y, t, p; p > 0 is ON.
class Hdf5Columns final : public Hdf5EventTable {
 public:
  /// `offset_us` is added to every time. What is odd is added to `notes`, which must outlive this. Throws an
  /// Error where a column cannot be used or their lengths differ.
  Hdf5Columns(const Hdf5File& file, const Hdf5ColumnPaths& paths, std::int64_t offset_us,
              std::vector<std::string>& notes);

  std::uint64_t rows() const override { return t_.dataset().rows(); }
  std::uint64_t chunk_rows() const override;
  std::uint64_t first_gap(std::uint64_t begin, std::uint64_t end) const override;
  std::optional<std::string> load(std::uint64_t begin, std::uint64_t count) override;
  void append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) override;

 private:
  std::array<const Hdf5Column*, 4> columns() const { return {&x_, &y_, &t_, &p_}; }
  void check_lengths() const;

  Hdf5Column x_, y_, t_, p_;
  EventRowAppender appender_;
  std::uint64_t loaded_begin_ = 0;
  EventRows rows_;  ///< reused
};

}  // namespace esi
