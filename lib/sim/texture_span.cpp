#include "esi/sim/texture_span.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "esi/sim/float_math.hpp"

namespace esi {
namespace {

/// So many pixels share one level of detail, and their coordinates are found in one go.
constexpr std::size_t kRun = 32;

/// Beyond the edge of a surface seen at a grazing angle its plane may run to infinity and come back from
/// behind; such pixels count next to nothing, but need a place.
constexpr float kFarthest = 1e6F;

/// Texel coordinates along a run of pixels.
struct Run {
  std::array<float, kRun> u, v;
};

/// The homography to the texture moved by whole periods, so that texels along a row are small and positive:
/// floats tell them apart, and integers cut from them round down.
cv::Matx33d moved_near(const cv::Matx33d& h, double x_begin, double x_end, double y, double period) {
  const cv::Vec2d a = mapped(h, {x_begin, y});
  const cv::Vec2d b = mapped(h, {x_end, y});
  cv::Matx33d moved = h;
  for (int axis = 0; axis < 2; ++axis) {
    const double shift = (1.0 - std::floor(std::min(a[axis], b[axis]) / period)) * period;
    for (int column = 0; column < 3; ++column) moved(axis, column) += shift * h(2, column);
  }
  return moved;
}

Run run_at(const cv::Matx33d& h, double x, double y) {
  const cv::Vec3d begin = h * cv::Vec3d(x, y, 1.0);
  const auto u = static_cast<float>(begin[0]), du = static_cast<float>(h(0, 0));
  const auto v = static_cast<float>(begin[1]), dv = static_cast<float>(h(1, 0));
  const auto w = static_cast<float>(begin[2]), dw = static_cast<float>(h(2, 0));
  Run run;
  for (std::size_t i = 0; i < kRun; ++i) {
    const auto step = static_cast<float>(static_cast<std::int32_t>(i));
    const float per_w = 1.0F / (w + step * dw);
    run.u[i] = std::min(std::max(0.0F, (u + step * du) * per_w), kFarthest);
    run.v[i] = std::min(std::max(0.0F, (v + step * dv) * per_w), kFarthest);
  }
  return run;
}

/// The level of detail at a pixel, where a pixel is two texels wide in the direction in which it spans more:
/// with the blur of Texture's levels that is about as sharp as light falling on square pixels (deviation 0.32
/// px).
double detail_at(const cv::Matx33d& h, double x, double y, double coarsest) {
  const cv::Vec3d p = h * cv::Vec3d(x, y, 1.0);
  const double u = p[0] / p[2], v = p[1] / p[2];
  const auto along = [&](int axis) {
    const double du = h(0, axis) - u * h(2, axis), dv = h(1, axis) - v * h(2, axis);
    return std::sqrt(du * du + dv * dv);
  };
  const double texels_per_pixel = std::max(along(0), along(1)) / p[2];
  if (!(texels_per_pixel > 0.0)) return coarsest;  // beyond infinity
  return std::clamp(std::numbers::log2e * fast_log(static_cast<float>(0.5 * texels_per_pixel)), 0.0,
                    coarsest);
}

/// Two texels beside each other, fetched as one number.
std::uint32_t pair_at(const std::uint16_t* texels) {
  std::uint32_t pair = 0;
  std::memcpy(&pair, texels, sizeof pair);
  return pair;
}
static_assert(std::endian::native == std::endian::little);
float left_of(std::uint32_t pair) { return static_cast<float>(static_cast<std::int32_t>(pair & 0xffffU)); }
float right_of(std::uint32_t pair) { return static_cast<float>(static_cast<std::int32_t>(pair >> 16)); }

/// Adds to `light` what one resolution of a texture shows at a run of pixels, between the four nearest
/// texels, times `gain`. In three loops, of which the compiler makes vector code but for the one that fetches
/// texels.
void add_level(const Texture& texture, int level, float gain, const Run& run,
               std::array<float, kRun>& light) {
  const auto [texels, side] = texture.level(level);
  const std::int32_t stride = side + 1;
  const float scale = 1.0F / static_cast<float>(1 << level);
  std::array<std::int32_t, kRun> column, row;
  std::array<float, kRun> a, b;
  for (std::size_t i = 0; i < kRun; ++i) {
    const float x = run.u[i] * scale - 0.5F, y = run.v[i] * scale - 0.5F;
    const auto left = static_cast<std::int32_t>(x), top = static_cast<std::int32_t>(y);
    a[i] = x - static_cast<float>(left);
    b[i] = y - static_cast<float>(top);
    column[i] = left & (side - 1);
    row[i] = top & (side - 1);
  }
  std::array<std::uint32_t, kRun> upper, lower;
  for (std::size_t i = 0; i < kRun; ++i) {
    const std::uint16_t* const texel = texels + (row[i] * stride + column[i]);
    upper[i] = pair_at(texel);
    lower[i] = pair_at(texel + stride);
  }
  for (std::size_t i = 0; i < kRun; ++i) {
    const float above = left_of(upper[i]) + a[i] * (right_of(upper[i]) - left_of(upper[i]));
    const float below = left_of(lower[i]) + a[i] * (right_of(lower[i]) - left_of(lower[i]));
    light[i] += gain * (above + b[i] * (below - above));
  }
}

}  // namespace

void sample_span(const ProjectedSurface& surface, int x, int y, std::span<float> light) {
  if (light.empty()) return;
  const Texture& texture = *surface.texture;
  const double x_end = x + static_cast<double>(light.size()) - 1.0;
  const cv::Matx33d h = moved_near(surface.to_texel, x, x_end, y, texture.side());
  const float gain = surface.gain / Texture::kOne;
  const double coarsest = texture.log2_side() - 1;
  for (std::size_t begin = 0; begin < light.size(); begin += kRun) {
    const std::size_t count = std::min(kRun, light.size() - begin);
    const double x_run = x + static_cast<double>(begin);
    const double middle = x_run + 0.5 * static_cast<double>(count - 1);
    const double detail = detail_at(h, middle, y, coarsest);
    const int level = static_cast<int>(detail);
    const auto share = static_cast<float>(detail - level);
    const Run run = run_at(h, x_run, y);
    std::array<float, kRun> seen{};
    add_level(texture, level, gain * (1.0F - share), run, seen);
    add_level(texture, level + 1, gain * share, run, seen);
    std::copy_n(seen.begin(), count, light.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

}  // namespace esi
