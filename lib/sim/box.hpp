#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

#include "esi/sim/surface.hpp"

namespace esi {

/// An upright box on the ground.
struct Box {
  cv::Vec2d centre_m;
  double heading_rad = 0.0;
  cv::Vec2d half_m;  ///< half of its length and width
  double height_m = 0.0;
  float gain = 1.0F;         ///< of the texture on its sides (and on its top, if it has no own)
  cv::Vec2d texture_offset;  ///< texels, so that not all boxes look alike

  cv::Vec3d length_axis() const;
  cv::Vec3d width_axis() const;

  /// Appends the sides that the viewer sees, in the order in which they may be drawn. Their ids are first_id
  /// on.
  void add_sides(const cv::Vec3d& viewer, const Texture& texture, int first_id,
                 std::vector<Surface>& out) const;
  /// The top with the box's texture.
  Surface top(const Texture& texture, int id) const;

  /// Whether the straight line between two points goes through the box.
  bool blocks(const cv::Vec3d& from, const cv::Vec3d& to) const;
};

inline constexpr int kBoxSides = 4;

}  // namespace esi
