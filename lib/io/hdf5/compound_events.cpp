#include "esi/io/hdf5/compound_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// A block of records is in memory at once.
constexpr std::size_t kMostRecordBytes = 256;

bool is_integer(H5T_class_t type) { return type == H5T_INTEGER || type == H5T_ENUM; }

void saturate(const std::vector<std::int64_t>& from, std::vector<std::int32_t>& to) {
  using Limits = std::numeric_limits<std::int32_t>;
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = static_cast<std::int32_t>(std::clamp<std::int64_t>(from[i], Limits::min(), Limits::max()));
  }
}

}  // namespace

CompoundEvents::CompoundEvents(const Hdf5File& file, const std::string& path, std::vector<std::string>& notes)
    : dataset_(file, path), appender_(file.name(), path, path, notes) {
  const Hdf5Lock lock;
  record_type_ = dataset_.type();
  check_records();
  x_ = field("x");
  y_ = field("y");
  p_ = field("p");
  t_ = field("t");
}

void CompoundEvents::check_records() const {
  if (H5Tget_class(record_type_.get()) != H5T_COMPOUND || dataset_.shape().rank != 1) {
    throw Error(dataset_.where() + " does not hold records with the fields x, y, p and t; convert it");
  }
  bool is_plain = dataset_.shape().value_bytes <= kMostRecordBytes;
  const int fields = H5Tget_nmembers(record_type_.get());
  for (int i = 0; i < fields; ++i) {
    const H5T_class_t type = H5Tget_member_class(record_type_.get(), static_cast<unsigned>(i));
    is_plain &= is_integer(type) || type == H5T_FLOAT;
  }
  if (is_plain) return;
  throw Error(
      fmt::format("{} has records of {} bytes, or fields that are no numbers; convert it to x, y, p, t",
                  dataset_.where(), dataset_.shape().value_bytes));
}

CompoundEvents::Field CompoundEvents::field(const char* name) const {
  const int index = H5Tget_member_index(record_type_.get(), name);
  if (index < 0) throw Error(fmt::format("{} has no field {}", dataset_.where(), name));
  const auto member = static_cast<unsigned>(index);
  Field field;
  field.type = Hdf5Handle(H5Tget_member_type(record_type_.get(), member));
  if (H5Tget_class(field.type.get()) == H5T_ENUM) field.type = Hdf5Handle(H5Tget_super(field.type.get()));
  field.offset_bytes = H5Tget_member_offset(record_type_.get(), member);
  field.size_bytes = H5Tget_size(field.type.get());
  const bool is_inside = field.offset_bytes + field.size_bytes <= dataset_.shape().value_bytes;
  if (H5Tget_class(field.type.get()) != H5T_INTEGER || field.size_bytes > 8 || !is_inside) {
    throw Error(
        fmt::format("{}: the field {} is no integer of at most 64 bits (times are in microseconds); "
                    "convert it",
                    dataset_.where(), name));
  }
  return field;
}

std::uint64_t CompoundEvents::first_gap(std::uint64_t begin, std::uint64_t end) const {
  return dataset_.first_gap(begin, end);
}

std::optional<std::string> CompoundEvents::load(std::uint64_t begin, std::uint64_t count) {
  loaded_begin_ = begin;
  records_.resize(count * dataset_.shape().value_bytes);
  const auto reason = dataset_.read(begin, count, record_type_.get(), records_.data());
  if (!reason) return std::nullopt;
  return fmt::format("dataset {} ({})", dataset_.path(), *reason);
}

void CompoundEvents::gather(const Field& field, std::size_t first, std::size_t count) {
  const std::size_t record_bytes = dataset_.shape().value_bytes;
  gathered_.resize(count);
  auto* to = reinterpret_cast<std::byte*>(gathered_.data());
  const std::byte* from = records_.data() + first * record_bytes + field.offset_bytes;
  for (std::size_t i = 0; i < count; ++i, to += field.size_bytes, from += record_bytes) {
    std::memcpy(to, from, field.size_bytes);
  }
  const Hdf5Lock lock;
  // In place. What does not fit is clipped.
  if (H5Tconvert(field.type.get(), H5T_NATIVE_INT64, count, gathered_.data(), nullptr, H5P_DEFAULT) < 0) {
    throw Error(fmt::format("{}: a field's type cannot be converted ({})", dataset_.where(),
                            last_hdf5_failure().reason));
  }
}

void CompoundEvents::append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) {
  rows_.resize(count);
  gather(x_, first, count);
  saturate(gathered_, rows_.x);
  gather(y_, first, count);
  saturate(gathered_, rows_.y);
  gather(p_, first, count);
  saturate(gathered_, rows_.p);
  gather(t_, first, count);
  rows_.t_us = gathered_;
  appender_.append(rows_, loaded_begin_ + first, packet, losses);
}

}  // namespace esi
