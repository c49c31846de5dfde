#include "esi/io/hdf5/column.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/event_rows.hpp"

namespace esi {
namespace {

template <class Target, class T>
Target saturated(T value) {
  using Limits = std::numeric_limits<Target>;
  if (std::cmp_less(value, Limits::min())) return Limits::min();
  if (std::cmp_greater(value, Limits::max())) return Limits::max();
  return static_cast<Target>(value);
}

template <class Target>
Target saturated(double seconds) {
  return saturated<Target>(us_or_none(seconds));
}

template <class Values, class Target>
void copy_values(const Values& values, std::size_t first, std::span<Target> target) {
  std::visit(
      [&](const auto& stored) {
        const auto* const from = stored.data() + first;
        for (std::size_t i = 0; i < target.size(); ++i) target[i] = saturated<Target>(from[i]);
      },
      values);
}

[[noreturn]] void refuse_type(const std::string& where, H5T_class_t type) {
  if (type == H5T_FLOAT) {
    throw Error(where +
                " holds floating-point numbers, but this layout has integers (times in microseconds); "
                "convert the column");
  }
  throw Error(where + " does not hold integers of at most 64 bits; convert the column");
}

}  // namespace

Hdf5Column::Hdf5Column(const Hdf5File& file, const std::string& path, TimeColumn kind)
    : dataset_(file, path) {
  if (dataset_.shape().rank > 1) {
    throw Error(
        fmt::format("{} has {} dimensions, but a column has one", dataset_.where(), dataset_.shape().rank));
  }
  kind == TimeColumn::seconds ? choose_float_type() : choose_integer_type();
}

void Hdf5Column::choose_float_type() {
  const Hdf5Lock lock;
  const Hdf5Handle stored_type = dataset_.type();
  if (H5Tget_class(stored_type.get()) != H5T_FLOAT || H5Tget_size(stored_type.get()) > 8) {
    throw Error(dataset_.where() +
                " does not hold floating-point numbers of at most 64 bits, but this layout has its times in "
                "seconds; convert the column");
  }
  memory_type_ = Hdf5Handle(H5Tcopy(H5T_NATIVE_DOUBLE));
  values_.emplace<std::vector<double>>();
}

void Hdf5Column::choose_integer_type() {
  const Hdf5Lock lock;
  const Hdf5Handle stored_type = dataset_.type();
  const H5T_class_t kind = H5Tget_class(stored_type.get());
  // h5py stores booleans as an enumeration of int8.
  const bool is_integer = kind == H5T_INTEGER || kind == H5T_ENUM;
  if (!is_integer || H5Tget_size(stored_type.get()) > 8) refuse_type(dataset_.where(), kind);
  memory_type_ = Hdf5Handle(H5Tget_native_type(stored_type.get(), H5T_DIR_ASCEND));
  const bool is_signed = H5Tget_sign(memory_type_.get()) == H5T_SGN_2;
  const auto hold = [&](auto with_sign, auto without_sign) {
    if (is_signed) {
      values_.emplace<std::vector<decltype(with_sign)>>();
    } else {
      values_.emplace<std::vector<decltype(without_sign)>>();
    }
  };
  switch (H5Tget_size(memory_type_.get())) {
    case 1:
      return hold(std::int8_t{}, std::uint8_t{});
    case 2:
      return hold(std::int16_t{}, std::uint16_t{});
    case 4:
      return hold(std::int32_t{}, std::uint32_t{});
    case 8:
      return hold(std::int64_t{}, std::uint64_t{});
    default:
      refuse_type(dataset_.where(), kind);
  }
}

std::optional<std::string> Hdf5Column::load(std::uint64_t begin, std::uint64_t count) {
  return std::visit(
      [&](auto& values) {
        values.resize(count);
        return dataset_.read(begin, count, memory_type_.get(), values.data());
      },
      values_);
}

void Hdf5Column::copy(std::size_t first, std::span<std::int64_t> target) const {
  copy_values(values_, first, target);
}

void Hdf5Column::copy(std::size_t first, std::span<std::int32_t> target) const {
  copy_values(values_, first, target);
}

}  // namespace esi
