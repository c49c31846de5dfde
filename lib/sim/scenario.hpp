#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/sim/camera.hpp"
#include "esi/sim/scene.hpp"
#include "esi/sim/trajectory.hpp"
#include "esi/sim/view.hpp"

namespace esi {

/// Where a tag is in the image.
struct SeenTag {
  std::int64_t id = 0;
  bool visible = false;  ///< faces the camera, all of its corners on the sensor, none behind an obstacle
  /// Px, pixel centres at integers, in AprilTag's order: as the tag is read lower left, lower right, upper
  /// right, upper left. All 0 where a corner isn't in front of the camera.
  std::array<cv::Vec2d, 4> corners;
};

/// What is true at any time, whatever the sensor makes of it.
class Scenario {
 public:
  /// `seed` decides how the scene looks and how a flight wanders.
  Scenario(const SceneOptions& scene, const TrajectoryOptions& trajectory, const CameraOptions& camera,
           std::int64_t seed);

  const Camera& camera() const { return camera_; }
  const Scene& scene() const { return scene_; }
  std::int64_t duration_us() const { return trajectory_->duration_us(); }
  std::vector<Phase> phases() const { return trajectory_->phases(); }

  Pose camera_pose(std::int64_t t_us) const;
  Pose board_pose(std::int64_t t_us) const;
  std::vector<SeenTag> tags(std::int64_t t_us) const;

  View view(std::int64_t t_us) const;
  /// Without noise, blur and thresholds; 255 is white.
  cv::Mat1b clean_frame(std::int64_t t_us) const;

 private:
  std::unique_ptr<Trajectory> trajectory_;
  Scene scene_;
  Camera camera_;
};

}  // namespace esi
