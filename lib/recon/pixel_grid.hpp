#pragma once

#include <cstddef>
#include <new>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// Throws the Error that a method can't have so many bytes for a sensor of that size.
[[noreturn]] void refuse_pixels(SensorSize size, std::size_t bytes, std::string_view method);

/// One `Pixel` for each of a sensor, row by row from the top.
template <class Pixel>
class PixelGrid {
 public:
  /// Throws an Error that names the method where memory doesn't suffice.
  PixelGrid(SensorSize size, const Pixel& value, std::string_view method)
      : width_(static_cast<std::size_t>(size.width_px)) {
    const std::size_t count = width_ * static_cast<std::size_t>(size.height_px);
    try {
      pixels_.assign(count, value);
    } catch (const std::bad_alloc&) {
      refuse_pixels(size, count * sizeof(Pixel), method);
    }
  }

  Pixel& at(const Event& event) { return pixels_[event.y * width_ + event.x]; }
  const Pixel* row(int y) const { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
  Pixel* row(int y) { return pixels_.data() + static_cast<std::size_t>(y) * width_; }

  auto begin() { return pixels_.begin(); }
  auto end() { return pixels_.end(); }

 private:
  std::size_t width_;
  std::vector<Pixel> pixels_;
};

}  // namespace esi
