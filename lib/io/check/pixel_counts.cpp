#include "esi/io/check/pixel_counts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace esi {
namespace {

constexpr std::size_t kMaxPixels = std::size_t{1} << 24;
constexpr int kReach_px = 2;
constexpr std::size_t kNeighbourhood_px = std::size_t{5} * 5;  // the pixel itself and all within reach

int power_of_two(int at_least) { return static_cast<int>(std::bit_ceil(static_cast<unsigned>(at_least))); }

}  // namespace

void PixelCounts::add(std::span<const Event> events) {
  for (const Event& event : events) {
    if (gave_up_) return;
    max_x_ = std::max<int>(max_x_, event.x);
    max_y_ = std::max<int>(max_y_, event.y);
    if (event.x >= width_ || event.y >= height_) grow(event.x, event.y);
    if (gave_up_) return;
    ++counts_[static_cast<std::size_t>(event.y) * static_cast<std::size_t>(width_) + event.x];
  }
}

void PixelCounts::grow(int x, int y) {
  const int width = std::max(width_, power_of_two(x + 1));
  const int height = std::max(height_, power_of_two(y + 1));
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > kMaxPixels) {
    gave_up_ = true;
    counts_ = {};
    return;
  }
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::ptrdiff_t row = 0; row < height_; ++row) {
    std::copy_n(counts_.begin() + row * width_, width_, counts.begin() + row * width);
  }
  counts_ = std::move(counts);
  width_ = width;
  height_ = height;
}

std::int64_t PixelCounts::at(int x, int y) const {
  return counts_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x)];
}

std::int64_t PixelCounts::median_around(int x, int y) const {
  std::array<std::int64_t, kNeighbourhood_px> around;
  auto end = around.begin();
  for (int v = std::max(0, y - kReach_px); v <= std::min(max_y_, y + kReach_px); ++v) {
    for (int u = std::max(0, x - kReach_px); u <= std::min(max_x_, x + kReach_px); ++u) {
      if (u != x || v != y) *end++ = at(u, v);
    }
  }
  if (end == around.begin()) return 0;
  const auto middle = around.begin() + (end - around.begin()) / 2;
  std::nth_element(around.begin(), middle, end);
  return *middle;
}

std::vector<HotPixel> PixelCounts::hot_pixels() const {
  std::vector<HotPixel> hot;
  if (gave_up_) return hot;
  for (int y = 0; y <= max_y_; ++y) {
    for (int x = 0; x <= max_x_; ++x) {
      const std::int64_t events = at(x, y);
      if (events >= kMinEvents && events > kFactor * median_around(x, y)) hot.push_back({x, y, events});
    }
  }
  std::stable_sort(hot.begin(), hot.end(),
                   [](const HotPixel& a, const HotPixel& b) { return a.events > b.events; });
  return hot;
}

}  // namespace esi
