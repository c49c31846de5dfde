#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// Part of a sensor: columns x..x+width-1, rows y..y+height-1.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Sorted events all over a region, polarities at random, from t = 0 on, 0..2*gap_us apart.
inline std::vector<Event> random_events(Region region, std::size_t count, int gap_us, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&random](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  std::vector<Event> events;
  std::int64_t t_us = 0;
  while (events.size() < count) {
    const auto x = static_cast<std::uint16_t>(region.x + below(region.width));
    const auto y = static_cast<std::uint16_t>(region.y + below(region.height));
    events.push_back({t_us, x, y, below(2) == 1});
    t_us += below(2 * gap_us + 1);
  }
  return events;
}

}  // namespace esi::test
