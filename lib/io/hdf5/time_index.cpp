#include "esi/io/hdf5/time_index.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/io/hdf5/column.hpp"

namespace esi {
namespace {

/// Longer than any recording; keeps microseconds within 64 bits.
constexpr std::uint64_t kMostEntries = std::uint64_t{1} << 40;

std::int64_t value_at(Hdf5Column& column, std::uint64_t row) {
  std::int64_t value = 0;
  if (const auto reason = column.load(row, 1)) throw Error(column.dataset().where() + ": " + *reason);
  column.copy(0, {&value, 1});
  return value;
}

bool entry_fits(Hdf5Column& index, Hdf5Column& times, std::uint64_t ms) {
  const std::int64_t entry = value_at(index, ms);
  if (entry < 0) return false;
  const auto event = static_cast<std::uint64_t>(entry);
  const std::uint64_t events = times.dataset().rows();
  const auto boundary_us = static_cast<std::int64_t>(ms) * 1000;
  if (event > events) return false;
  if (event < events && value_at(times, event) < boundary_us) return false;
  return event == 0 || value_at(times, event - 1) < boundary_us;
}

}  // namespace

std::string check_time_index(const Hdf5File& file, const std::string& index_path,
                             const std::string& times_path) {
  try {
    Hdf5Column index(file, index_path);
    Hdf5Column times(file, times_path);
    const std::uint64_t entries = std::min(index.dataset().rows(), kMostEntries);
    for (std::uint64_t quarter = 1; quarter <= 4 && entries > 0; ++quarter) {
      const std::uint64_t ms = entries * quarter / 4 - (quarter == 4 ? 1 : 0);
      if (!entry_fits(index, times, ms)) {
        return fmt::format("{} contradicts the times at {} ms; it is not used", index_path, ms);
      }
    }
  } catch (const Error& error) {
    return fmt::format("{} is not used: {}", index_path, error.what());
  }
  return {};
}

}  // namespace esi
