#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// Events over time, in at most kMaxBins equal bins whatever the recording's length: each time they are full,
/// two become one.
class EventRate {
 public:
  static constexpr std::size_t kMaxBins = 64;

  void add(std::span<const Event> events);

  /// 1 ms times a power of two. The first bin begins at the first event.
  std::int64_t bin_us() const { return bin_us_; }
  /// Events a bin, up to the last event's bin.
  std::span<const std::int64_t> bins() const { return bins_; }

 private:
  void widen();

  std::int64_t begin_us_ = 0;
  std::int64_t bin_us_ = 1000;
  std::vector<std::int64_t> bins_;
};

}  // namespace esi
