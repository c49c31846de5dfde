#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace esi {

/// A square image of reflectance, 0 to 1, that repeats in both directions, with half, quarter, ...
/// resolutions down to one texel, so that it can be looked at from afar without aliasing. Texel (i, j) covers
/// [i, i+1) x [j, j+1): its centre is at i + 0.5.
class Texture {
 public:
  /// Stored value of reflectance 1.
  static constexpr float kOne = 65535.0F;

  /// One resolution, row by row. Each row goes on with its first texel, and the last row is the first again:
  /// the four texels around any point lie beside and below one another without wrapping round.
  struct Level {
    const std::uint16_t* texels;
    std::int32_t side;
    std::int32_t stride() const { return side + 1; }
  };

  /// `texels` row by row, 2^log2_side squared of them.
  Texture(const std::vector<float>& texels, int log2_side);

  int log2_side() const { return log2_side_; }
  int side() const { return 1 << log2_side_; }

  /// Level 0 is the image itself; level k has side() >> k texels a side.
  Level level(int k) const { return {texels_.data() + begins_[static_cast<std::size_t>(k)], side() >> k}; }

 private:
  void add_level(const std::vector<float>& texels, std::size_t side);

  int log2_side_;
  std::vector<std::uint16_t> texels_;  ///< all levels, one behind the other
  std::vector<std::size_t> begins_;    ///< of each level
};

}  // namespace esi
