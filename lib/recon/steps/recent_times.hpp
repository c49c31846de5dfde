#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// When every pixel last fired, for steps that look back a bounded while. 32 bits a pixel, counted from an
/// epoch that follows the stream, so that any int64 time and any length of recording is exact. Around the
/// sensor lies a border of pixels that never fire.
class RecentTimes {
 public:
  /// The longest while that can be looked back.
  static constexpr std::int64_t kLongest_us = 1 << 29;

  explicit RecentTimes(SensorSize size)
      : stride_(static_cast<std::size_t>(size.width_px) + 2),
        cells_us_(stride_ * (static_cast<std::size_t>(size.height_px) + 2), kLongAgo_us) {}

  std::size_t stride() const { return stride_; }

  /// The event's time as cells have it. Events come in order.
  std::int32_t now(const Event& event) {
    // Unsigned, so that no pair of times overflows.
    const std::uint64_t since_us = static_cast<std::uint64_t>(event.t_us) - epoch_us_;
    if (since_us <= kSpan_us) return static_cast<std::int32_t>(since_us);
    move_epoch(since_us);
    return 0;
  }

  /// The event's pixel; its neighbours lie 1 and stride() away.
  std::int32_t& cell_us(const Event& event) { return cells_us_[(event.y + 1U) * stride_ + event.x + 1U]; }

 private:
  static constexpr std::int32_t kSpan_us = (1 << 30) - 1;
  static constexpr std::int32_t kLongAgo_us = -kSpan_us;  ///< differences from it fit in 31 bits

  void move_epoch(std::uint64_t by_us) {
    epoch_us_ += by_us;
    const auto by = static_cast<std::int64_t>(std::min<std::uint64_t>(by_us, std::uint64_t{1} << 32));
    for (std::int32_t& cell : cells_us_) {
      cell = static_cast<std::int32_t>(std::max<std::int64_t>(cell - by, kLongAgo_us));
    }
  }

  std::size_t stride_;
  std::vector<std::int32_t> cells_us_;
  std::uint64_t epoch_us_ = 0;
};

}  // namespace esi
