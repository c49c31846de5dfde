#include "esi/sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "esi/sim/board.hpp"
#include "esi/sim/renderer.hpp"

namespace esi {
namespace {

/// To 2^-30 (a nanometre): sines and square roots may differ in their last bit from machine to machine, what
/// is made from poses must not.
Pose rounded(Pose pose) {
  const auto round = [](double value) { return std::round(value * 0x1p30) * 0x1p-30; };
  std::transform(pose.rotation.val, pose.rotation.val + 9, pose.rotation.val, round);
  std::transform(pose.position_m.val, pose.position_m.val + 3, pose.position_m.val, round);
  return pose;
}

/// The corners of a tag on the board, in AprilTag's order.
std::array<cv::Vec3d, 4> corners_of(const BoardTag& tag) {
  const double half = 0.5 * tag.size_m;
  const auto corner = [&](double x, double y) {
    return cv::Vec3d(tag.centre_m[0] + x * half, tag.centre_m[1] + y * half, 0.0);
  };
  return {corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)};
}

}  // namespace

Scenario::Scenario(const SceneOptions& scene, const TrajectoryOptions& trajectory,
                   const CameraOptions& camera, std::int64_t seed)
    : trajectory_(make_trajectory(trajectory, seed)), scene_(scene, *trajectory_, seed), camera_(camera) {}

Pose Scenario::camera_pose(std::int64_t t_us) const { return rounded(trajectory_->camera(t_us)); }
Pose Scenario::board_pose(std::int64_t t_us) const { return rounded(trajectory_->board(t_us)); }

std::vector<SeenTag> Scenario::tags(std::int64_t t_us) const {
  const Pose camera = camera_pose(t_us);
  const Pose board = board_pose(t_us);
  const Pose board_to_camera = camera.inverse() * board;
  const bool faces = board_to_camera.rotation.col(2).dot(cv::Matx31d(board_to_camera.position_m)) > 0.0;
  std::vector<SeenTag> seen;
  for (const BoardTag& tag : board_tags()) {
    SeenTag& out = seen.emplace_back(SeenTag{tag.id, faces, {}});
    const auto corners = corners_of(tag);
    const auto is_in_front = [&](const cv::Vec3d& corner) { return (board_to_camera * corner)[2] > 0.0; };
    if (!std::all_of(corners.begin(), corners.end(), is_in_front)) {
      out.visible = false;
      continue;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      out.corners[i] = camera_.project(board_to_camera * corners[i]);
      out.visible =
          out.visible && camera_.sees(out.corners[i]) && !scene_.hides(camera.position_m, board * corners[i]);
    }
  }
  return seen;
}

View Scenario::view(std::int64_t t_us) const {
  const Pose camera = camera_pose(t_us);
  return project(scene_.surfaces(camera.position_m, board_pose(t_us)), camera, camera_);
}

cv::Mat1b Scenario::clean_frame(std::int64_t t_us) const {
  const View seen = view(t_us);
  const SensorSize size = camera_.size;
  cv::Mat1b frame(size.height_px, size.width_px);
  std::vector<float> light(static_cast<std::size_t>(size.width_px));
  for (int y = 0; y < size.height_px; ++y) {
    render_row(seen, y, light);
    std::transform(light.begin(), light.end(), frame[y], [](float value) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
    });
  }
  return frame;
}

}  // namespace esi
