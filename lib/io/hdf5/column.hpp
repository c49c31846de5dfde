#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "esi/io/hdf5/dataset.hpp"

namespace esi {

/// What a column's values are: integers, which times in microseconds are, too; or seconds in floating point.
enum class TimeColumn { microseconds, seconds };

/// A scalar or one-dimensional dataset of integers of any width up to 64 bits, sign and byte order, or of
/// seconds in floating point, which become microseconds.
class Hdf5Column {
 public:
  /// Throws an Error where the dataset has another type or rank; see Hdf5Dataset.
  Hdf5Column(const Hdf5File& file, const std::string& path, TimeColumn kind = TimeColumn::microseconds);

  const Hdf5Dataset& dataset() const { return dataset_; }

  /// See Hdf5Dataset::read. The values are kept until the next call.
  std::optional<std::string> load(std::uint64_t begin, std::uint64_t count);

  /// Copies loaded values from `first` on. What the target's type does not hold becomes its smallest or
  /// largest value; seconds that are no number become the largest.
  void copy(std::size_t first, std::span<std::int64_t> target) const;
  void copy(std::size_t first, std::span<std::int32_t> target) const;

 private:
  void choose_integer_type();
  void choose_float_type();

  Hdf5Dataset dataset_;
  /// As stored, but in this machine's byte order: HDF5 would clip what does not fit into another type.
  std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
               std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
               std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<double>>
      values_;
  Hdf5Handle memory_type_;
};

}  // namespace esi
