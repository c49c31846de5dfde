#pragma once

#include <array>
#include <opencv2/core/matx.hpp>

#include "esi/sim/texture.hpp"

namespace esi {

/// A flat textured rectangle in the world. Seen from its front, u goes right and v down.
struct Surface {
  int id = 0;  ///< the same at all times
  const Texture* texture = nullptr;
  float gain = 1.0F;  ///< of the texture's reflectance, for shade and paint
  /// Texel (u, v) is at origin + u * along_u + v * along_v.
  cv::Vec3d origin, along_u, along_v;
  /// Texels: upper left, upper right, lower right, lower left.
  std::array<cv::Vec2d, 4> corners;
  /// Whether the upper, right, lower, left edge goes on beneath a surface drawn later, which it touches.
  /// Without that what is behind both would shine through their smoothed edges.
  std::array<bool, 4> runs_under{};

  cv::Vec3d at(const cv::Vec2d& texel) const { return origin + texel[0] * along_u + texel[1] * along_v; }
  bool faces(const cv::Vec3d& viewer) const { return along_u.cross(along_v).dot(origin - viewer) > 0.0; }
};

}  // namespace esi
