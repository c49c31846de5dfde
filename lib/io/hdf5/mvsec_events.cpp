#include "esi/io/hdf5/mvsec_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr std::uint64_t kValuesPerEvent = 4;

std::int32_t coordinate(double value) {
  const bool is_16_bits = value >= 0 && value <= 65535;
  if (!is_16_bits || value != std::floor(value)) return kNoCoordinate;
  return static_cast<std::int32_t>(value);
}

/// Away from zero, so that what is above 0 stays there; 0 for what is no number.
std::int32_t polarity(double value) {
  if (std::isnan(value)) return 0;
  return static_cast<std::int32_t>(std::ceil(std::clamp(value, -1.0, 2147483647.0)));
}

}  // namespace

MvsecEvents::MvsecEvents(const Hdf5File& file, const std::string& path, std::vector<std::string>& notes)
    : dataset_(file, path), appender_(file.name(), path, path, notes) {
  const Hdf5Lock lock;
  const Hdf5Handle type = dataset_.type();
  if (H5Tget_class(type.get()) != H5T_FLOAT || H5Tget_size(type.get()) > sizeof(double)) {
    throw Error(dataset_.where() +
                " does not hold floating-point numbers of at most 64 bits, but MVSEC's rows are x, y, t in "
                "seconds, p; convert it to float64");
  }
  if (dataset_.shape().rank == 2 && dataset_.shape().values_per_row() == kValuesPerEvent) return;
  throw Error(fmt::format("{} has {} dimensions with {} values per row, but MVSEC's rows are x, y, t, p",
                          dataset_.where(), dataset_.shape().rank, dataset_.shape().values_per_row()));
}

std::uint64_t MvsecEvents::first_gap(std::uint64_t begin, std::uint64_t end) const {
  return dataset_.first_gap(begin, end);
}

std::optional<std::string> MvsecEvents::load(std::uint64_t begin, std::uint64_t count) {
  loaded_begin_ = begin;
  values_.resize(count * kValuesPerEvent);
  const auto reason = dataset_.read(begin, count, H5T_NATIVE_DOUBLE, values_.data());
  if (!reason) return std::nullopt;
  return fmt::format("dataset {} ({})", dataset_.path(), *reason);
}

void MvsecEvents::append(std::size_t first, std::size_t count, Packet& packet, Losses& losses) {
  rows_.resize(count);
  const double* from = values_.data() + first * kValuesPerEvent;
  for (std::size_t i = 0; i < count; ++i, from += kValuesPerEvent) {
    rows_.x[i] = coordinate(from[0]);
    rows_.y[i] = coordinate(from[1]);
    rows_.t_us[i] = us_or_none(from[2]);
    rows_.p[i] = polarity(from[3]);
  }
  appender_.append(rows_, loaded_begin_ + first, packet, losses);
}

}  // namespace esi
