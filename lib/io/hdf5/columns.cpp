#include "esi/io/hdf5/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// What Hdf5Column makes of unsigned times that int64 does not hold.
constexpr std::int64_t kBeyondInt64 = std::numeric_limits<std::int64_t>::max();

bool fits_16_bits(std::int32_t coordinate) { return (coordinate & ~0xFFFF) == 0; }

template <class T>
const T* fill(std::vector<T>& values, const Hdf5Column& column, std::size_t first, std::size_t count) {
  values.resize(count);
  column.copy(first, std::span(values));
  return values.data();
}

}  // namespace

Hdf5Columns::Hdf5Columns(const Hdf5File& file, const std::string& group, std::int64_t offset_us,
                         std::vector<std::string>& notes)
    : x_(file, group + "x"),
      y_(file, group + "y"),
      t_(file, group + "t"),
      p_(file, group + "p"),
      offset_us_(offset_us),
      notes_(&notes) {
  check_lengths();
}

void Hdf5Columns::check_lengths() const {
  for (const Hdf5Column* column : columns()) {
    if (column->dataset().shape().rank == 0)
      throw Error(column->dataset().where() + " is a single value, not a column");
    if (column->dataset().rows() == rows()) continue;
    throw Error(fmt::format("{} has {} rows, but t has {}; all columns must have the same length",
                            column->dataset().where(), column->dataset().rows(), rows()));
  }
}

std::uint64_t Hdf5Columns::chunk_rows() const {
  std::uint64_t largest = 0;
  for (const Hdf5Column* column : columns())
    largest = std::max(largest, column->dataset().shape().chunk_rows);
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

// One plain loop; what it meets that is odd is only noticed, and looked for afterwards.
void Hdf5Columns::append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) {
  const std::int32_t* const x = fill(x_values_, x_, first, count);
  const std::int32_t* const y = fill(y_values_, y_, first, count);
  const std::int64_t* const t = fill(t_values_, t_, first, count);
  const std::int32_t* const p = fill(p_values_, p_, first, count);

  events_.resize(count);
  Event* const events = events_.data();
  bool is_time_odd = false;
  std::int32_t coordinate_bits = 0;
  std::int32_t largest_p = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::int64_t t_us = 0;
    is_time_odd |= __builtin_add_overflow(t[i], offset_us_, &t_us) || t[i] == kBeyondInt64;
    events[i] = {t_us, static_cast<std::uint16_t>(x[i]), static_cast<std::uint16_t>(y[i]), p[i] > 0};
    coordinate_bits |= x[i] | y[i];
    largest_p = std::max(largest_p, p[i]);
  }
  if (is_time_odd) refuse_time(loaded_begin_ + first);
  if (largest_p > 1) note_polarity(loaded_begin_ + first);
  if (!fits_16_bits(coordinate_bits)) drop_outside(losses);
  packet.events.insert(packet.events.end(), events_.begin(), events_.end());
}

/// Takes out the events whose coordinates 16 bits don't hold.
void Hdf5Columns::drop_outside(Losses& losses) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (fits_16_bits(x_values_[i] | y_values_[i])) events_[kept++] = events_[i];
  }
  losses.add(Drop::outside_sensor, static_cast<std::int64_t>(events_.size() - kept));
  events_.resize(kept);
}

void Hdf5Columns::refuse_time(std::uint64_t first_row) const {
  const auto odd = std::find_if(t_values_.begin(), t_values_.end(), [this](std::int64_t t_us) {
    std::int64_t sum = 0;
    return t_us == kBeyondInt64 || __builtin_add_overflow(t_us, offset_us_, &sum);
  });
  throw Error(fmt::format("{}, row {}: the time, with the offset {} us added, does not fit into 64 bits",
                          t_.dataset().where(),
                          first_row + static_cast<std::uint64_t>(odd - t_values_.begin()), offset_us_));
}

void Hdf5Columns::note_polarity(std::uint64_t first_row) {
  if (polarity_is_noted_) return;
  const auto odd = std::find_if(p_values_.begin(), p_values_.end(), [](std::int32_t p) { return p > 1; });
  polarity_is_noted_ = true;
  notes_->push_back(fmt::format(
      "dataset {}, row {}: polarity {} is none of 0, 1 and -1; every p > 0 is taken as ON",
      p_.dataset().path(), first_row + static_cast<std::uint64_t>(odd - p_values_.begin()), *odd));
}

}  // namespace esi
