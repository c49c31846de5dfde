#include "esi/sim/ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "esi/sim/random.hpp"

namespace esi {
namespace {

constexpr int kLog2Side = 11;
constexpr int kLog2CoarsestSide = 2;
constexpr double kMinReflectance = 0.02;
constexpr double kMaxReflectance = 0.90;

using Image = std::vector<float>;

/// Twice as many texels a side: between neighbours 3 : 1 (a quadratic B-spline), round the repeating border.
Image upsampled(const Image& image, std::size_t side) {
  Image wide(image.size() * 2), large(image.size() * 4);
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const float* const row = &image[y * side];
      float* const out = &wide[2 * (y * side + x)];
      out[0] = 0.75F * row[x] + 0.25F * row[(x + side - 1) % side];
      out[1] = 0.75F * row[x] + 0.25F * row[(x + 1) % side];
    }
  }
  const std::size_t width = 2 * side;
  for (std::size_t y = 0; y < side; ++y) {
    const float* const row = &wide[y * width];
    const float* const above = &wide[(y + side - 1) % side * width];
    const float* const below = &wide[(y + 1) % side * width];
    float* const out = &large[2 * y * width];
    for (std::size_t x = 0; x < width; ++x) {
      out[x] = 0.75F * row[x] + 0.25F * above[x];
      out[x + width] = 0.75F * row[x] + 0.25F * below[x];
    }
  }
  return large;
}

/// A sum of noise at every resolution, equally strong in each octave: amplitude falls as 1/f.
Image pink_noise(std::int64_t seed) {
  Image image;
  for (int log2_side = kLog2CoarsestSide; log2_side <= kLog2Side; ++log2_side) {
    image = image.empty() ? Image(std::size_t{1} << (2 * log2_side))
                          : upsampled(image, std::size_t{1} << (log2_side - 1));
    const RandomKey random(seed, RandomStream::ground, static_cast<std::uint64_t>(log2_side));
    for (std::size_t i = 0; i < image.size(); ++i) {
      image[i] += static_cast<float>(random.uniform(i, -1.0, 1.0));
    }
  }
  return image;
}

}  // namespace

Texture ground_texture(double reflectance, double contrast, std::int64_t seed) {
  Image image = pink_noise(seed);
  double sum = 0.0, sum_of_squares = 0.0;
  for (const float value : image) {
    sum += value;
    sum_of_squares += static_cast<double>(value) * value;
  }
  const double mean = sum / static_cast<double>(image.size());
  const double deviation = std::sqrt(sum_of_squares / static_cast<double>(image.size()) - mean * mean);
  for (float& value : image) {
    const double lit = reflectance * std::exp(contrast * (value - mean) / deviation);
    value = static_cast<float>(std::clamp(lit, kMinReflectance, kMaxReflectance));
  }
  return {image, kLog2Side};
}

}  // namespace esi
