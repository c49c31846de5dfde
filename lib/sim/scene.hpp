#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/core/pose.hpp"
#include "esi/sim/box.hpp"
#include "esi/sim/surface.hpp"
#include "esi/sim/texture.hpp"
#include "esi/sim/trajectory.hpp"

namespace esi {

struct SceneOptions {
  double ground_reflectance = 0.25;
  double ground_contrast = 0.35;
  std::int64_t obstacles = 14;

  void declare(OptionTable& table);
};

/// What there is to see: textured ground, obstacles, and a vehicle with the board on top.
class Scene {
 public:
  /// Obstacles stand beside the vehicle's way; `seed` decides where, and how all looks.
  Scene(const SceneOptions& options, const Trajectory& trajectory, std::int64_t seed);

  /// The surfaces that face the camera, farthest first, in the order in which they are to be drawn.
  std::vector<Surface> surfaces(const cv::Vec3d& camera, const Pose& board) const;

  /// Whether an obstacle hides a point from the camera.
  bool hides(const cv::Vec3d& camera, const cv::Vec3d& point) const;

  const std::vector<Box>& obstacles() const { return obstacles_; }

 private:
  Surface ground(const cv::Vec3d& camera) const;

  Texture ground_texture_;
  Texture board_texture_;
  std::vector<Box> obstacles_;
};

}  // namespace esi
