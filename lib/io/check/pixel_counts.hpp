#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// A pixel that fires far more often than its neighbours, whatever it sees.
struct HotPixel {
  int x = 0;
  int y = 0;
  std::int64_t events = 0;

  friend bool operator==(const HotPixel&, const HotPixel&) = default;
};

/// Events per pixel, of a sensor whose size need not be known.
class PixelCounts {
 public:
  void add(std::span<const Event> events);

  /// Whether counting was given up: coordinates need more than 16 million pixels.
  bool gave_up() const { return gave_up_; }

  /// Pixels with at least kMinEvents events, and more than kFactor times as many as the median of the 24
  /// around them (fewer at the border), busiest first. Edges and flickering lamps excite neighbours alike.
  std::vector<HotPixel> hot_pixels() const;

  static constexpr std::int64_t kMinEvents = 20;
  static constexpr std::int64_t kFactor = 10;

 private:
  void grow(int x, int y);
  std::int64_t at(int x, int y) const;
  std::int64_t median_around(int x, int y) const;

  int width_ = 0, height_ = 0;  ///< of what is counted; powers of two
  int max_x_ = -1, max_y_ = -1;
  std::vector<std::uint32_t> counts_;  ///< row by row
  bool gave_up_ = false;
};

}  // namespace esi
