#include "esi/io/hdf5/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"

namespace esi {

Hdf5Columns::Hdf5Columns(const Hdf5File& file, const Hdf5ColumnPaths& paths, std::int64_t offset_us,
                         std::vector<std::string>& notes)
    : x_(file, paths.x),
      y_(file, paths.y),
      t_(file, paths.t, paths.time),
      p_(file, paths.p),
      appender_(file.name(), paths.t, paths.p, notes, offset_us) {
  check_lengths();
}

void Hdf5Columns::check_lengths() const {
  for (const Hdf5Column* column : columns()) {
    if (column->dataset().shape().rank == 0)
      throw Error(column->dataset().where() + " is a single value, not a column");
    if (column->dataset().rows() == rows()) continue;
    throw Error(fmt::format("{} has {} rows, but {} has {}; all columns must have the same length",
                            column->dataset().where(), column->dataset().rows(), t_.dataset().path(),
                            rows()));
  }
}

std::uint64_t Hdf5Columns::chunk_rows() const {
  std::uint64_t largest = 0;
  for (const Hdf5Column* column : columns())
    largest = std::max(largest, column->dataset().shape().chunk_rows());
  return largest;
}

std::uint64_t Hdf5Columns::first_gap(std::uint64_t begin, std::uint64_t end) const {
  for (const Hdf5Column* column : columns()) end = column->dataset().first_gap(begin, end);
  return end;
}

std::optional<std::string> Hdf5Columns::load(std::uint64_t begin, std::uint64_t count) {
  loaded_begin_ = begin;
  for (Hdf5Column* column : {&x_, &y_, &t_, &p_}) {
    if (const auto reason = column->load(begin, count)) {
      return fmt::format("dataset {} ({})", column->dataset().path(), *reason);
    }
  }
  return std::nullopt;
}

void Hdf5Columns::append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) {
  rows_.resize(count);
  x_.copy(first, std::span(rows_.x));
  y_.copy(first, std::span(rows_.y));
  t_.copy(first, std::span(rows_.t_us));
  p_.copy(first, std::span(rows_.p));
  appender_.append(rows_, loaded_begin_ + first, packet, losses);
}

}  // namespace esi
