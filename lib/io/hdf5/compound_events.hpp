#pragma once

#include <string>
#include <vector>

#include "esi/io/hdf5/dataset.hpp"
#include "esi/io/hdf5/event_rows.hpp"
#include "esi/io/hdf5/event_table.hpp"

namespace esi {

/// Events as one dataset of records with the fields x, y, p and t, in any order and among others: integers of
/// any width up to 64 bits, t in microseconds, p > 0 is ON.
class CompoundEvents final : public Hdf5EventTable {
 public:
  /// What is odd is added to `notes`, which must outlive this. Throws an Error where the records are of
  /// another kind.
  CompoundEvents(const Hdf5File& file, const std::string& path, std::vector<std::string>& notes);

  std::uint64_t rows() const override { return dataset_.rows(); }
  std::uint64_t chunk_rows() const override { return dataset_.shape().chunk_rows(); }
  std::uint64_t first_gap(std::uint64_t begin, std::uint64_t end) const override;
  std::optional<std::string> load(std::uint64_t begin, std::uint64_t count) override;
  void append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) override;

 private:
  struct Field {
    std::size_t offset_bytes = 0, size_bytes = 0;
    Hdf5Handle type;
  };

  Field field(const char* name) const;
  void check_records() const;
  /// Copies a field of `count` loaded records; what int64 does not hold is its largest value.
  void gather(const Field& field, std::size_t first, std::size_t count);

  Hdf5Dataset dataset_;
  Hdf5Handle record_type_;
  Field x_, y_, p_, t_;
  EventRowAppender appender_;
  std::uint64_t loaded_begin_ = 0;
  std::vector<std::byte> records_;  ///< these are reused
  std::vector<std::int64_t> gathered_;
  EventRows rows_;
};

}  // namespace esi
