#pragma once

#include <string>
#include <vector>

#include "esi/io/hdf5/dataset.hpp"
#include "esi/io/hdf5/event_rows.hpp"
#include "esi/io/hdf5/event_table.hpp"

namespace esi {

/// Events as rows of four floating-point numbers x, y, t, p: t in seconds, p > 0 is ON.
class MvsecEvents final : public Hdf5EventTable {
 public:
  /// What is odd is added to `notes`, which must outlive this. Throws an Error where the dataset is of
  /// another kind.
  MvsecEvents(const Hdf5File& file, const std::string& path, std::vector<std::string>& notes);

  std::uint64_t rows() const override { return dataset_.rows(); }
  std::uint64_t chunk_rows() const override { return dataset_.shape().chunk_rows(); }
  std::uint64_t first_gap(std::uint64_t begin, std::uint64_t end) const override;
  std::optional<std::string> load(std::uint64_t begin, std::uint64_t count) override;
  void append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) override;

 private:
  Hdf5Dataset dataset_;
  EventRowAppender appender_;
  std::uint64_t loaded_begin_ = 0;
  std::vector<double> values_;  ///< these and the rows are reused
  EventRows rows_;
};

}  // namespace esi
