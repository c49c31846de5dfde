#include "esi/sim/texture.hpp"

#include <algorithm>
#include <cmath>

namespace esi {
namespace {

/// Half as many rows: each the mean of four, 1 : 3 : 3 : 1. (With the mean of two, an edge would seem to lie
/// up to a twelfth of a texel from its place, depending on where it falls between texels.)
std::vector<float> with_half_the_rows(const std::vector<float>& texels, std::size_t rows) {
  const std::size_t columns = texels.size() / rows;
  std::vector<float> result(texels.size() / 2);
  for (std::size_t y = 0; y < rows / 2; ++y) {
    const float* const above = &texels[(2 * y + rows - 1) % rows * columns];
    const float* const upper = &texels[2 * y * columns];
    const float* const lower = &texels[(2 * y + 1) * columns];
    const float* const below = &texels[(2 * y + 2) % rows * columns];
    for (std::size_t x = 0; x < columns; ++x) {
      result[y * columns + x] = 0.125F * (above[x] + below[x]) + 0.375F * (upper[x] + lower[x]);
    }
  }
  return result;
}

std::vector<float> transposed(const std::vector<float>& texels, std::size_t rows) {
  const std::size_t columns = texels.size() / rows;
  std::vector<float> result(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i) result[i % columns * rows + i / columns] = texels[i];
  return result;
}

std::vector<float> halved(const std::vector<float>& texels, std::size_t side) {
  const std::vector<float> on_its_side = transposed(with_half_the_rows(texels, side), side / 2);
  return transposed(with_half_the_rows(on_its_side, side), side / 2);
}

}  // namespace

Texture::Texture(const std::vector<float>& texels, int log2_side) : log2_side_(log2_side) {
  std::vector<float> image = texels;
  for (int level = 0; level <= log2_side; ++level) {
    const std::size_t side = std::size_t{1} << (log2_side - level);
    if (level > 0) image = halved(image, 2 * side);
    add_level(image, side);
  }
}

void Texture::add_level(const std::vector<float>& texels, std::size_t side) {
  begins_.push_back(texels_.size());
  for (std::size_t y = 0; y <= side; ++y) {
    for (std::size_t x = 0; x <= side; ++x) {
      const float value = texels[y % side * side + x % side];
      texels_.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * kOne)));
    }
  }
}

}  // namespace esi
