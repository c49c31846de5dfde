#include "esi/sim/scene.hpp"

#include <algorithm>
#include <cmath>

#include "esi/sim/board.hpp"
#include "esi/sim/ground.hpp"
#include "esi/sim/obstacles.hpp"

namespace esi {
namespace {

/// Behind that the ground ends, well above what a camera that looks down sees.
constexpr double kGroundReach_m = 60.0;

constexpr int kGroundId = 0;
constexpr int kVehicleId = 1;
constexpr int kObstacleId = 100;
constexpr int kIdsPerBox = kBoxSides + 1;

Box vehicle_at(const Pose& board) {
  Box box;
  box.centre_m = {board.position_m[0], board.position_m[1]};
  box.heading_rad = std::atan2(board.rotation(1, 0), board.rotation(0, 0));
  box.half_m = {0.5 * kDeckSide_m, 0.5 * kDeckSide_m};
  box.height_m = board.position_m[2];
  box.gain = 0.3F;
  return box;
}

Surface deck_at(const Pose& board, const Texture& texture) {
  Surface deck;
  deck.id = kVehicleId + kBoxSides;
  deck.texture = &texture;
  deck.along_u = kBoardTexel_m * cv::Vec3d(board.rotation(0, 0), board.rotation(1, 0), board.rotation(2, 0));
  deck.along_v = kBoardTexel_m * cv::Vec3d(board.rotation(0, 1), board.rotation(1, 1), board.rotation(2, 1));
  const double side = texture.side();
  deck.origin = board.position_m - 0.5 * side * (deck.along_u + deck.along_v);
  deck.corners = {cv::Vec2d(0, 0), {side, 0}, {side, side}, {0, side}};
  return deck;
}

}  // namespace

void SceneOptions::declare(OptionTable& table) {
  table.real("ground_reflectance", ground_reflectance, {0.03, 0.8}, "",
             "median reflectance of the ground (asphalt 0.1, grass 0.25, concrete 0.4)");
  table.real("ground_contrast", ground_contrast, {0.0, 1.5}, "ln",
             "deviation of the ground's log reflectance, whose spectrum is that of natural images");
  table.integer("obstacles", obstacles, {0, 200}, "", "boxes beside the vehicle's way where it turns");
}

Scene::Scene(const SceneOptions& options, const Trajectory& trajectory, std::int64_t seed)
    : ground_texture_(ground_texture(options.ground_reflectance, options.ground_contrast, seed)),
      board_texture_(board_texture()),
      obstacles_(place_obstacles(options.obstacles, trajectory, seed)) {}

Surface Scene::ground(const cv::Vec3d& camera) const {
  Surface ground;
  ground.id = kGroundId;
  ground.texture = &ground_texture_;
  ground.along_u = {kGroundTexel_m, 0, 0};
  ground.along_v = {0, -kGroundTexel_m, 0};
  const cv::Vec2d middle = cv::Vec2d(camera[0], -camera[1]) / kGroundTexel_m;
  const double reach = kGroundReach_m / kGroundTexel_m;
  ground.corners = {middle + cv::Vec2d(-reach, -reach), middle + cv::Vec2d(reach, -reach),
                    middle + cv::Vec2d(reach, reach), middle + cv::Vec2d(-reach, reach)};
  return ground;
}

std::vector<Surface> Scene::surfaces(const cv::Vec3d& camera, const Pose& board) const {
  const Box vehicle = vehicle_at(board);
  std::vector<const Box*> boxes{&vehicle};
  for (const Box& box : obstacles_) boxes.push_back(&box);
  const auto distance_m = [&camera](const Box* box) {
    return std::hypot(box->centre_m[0] - camera[0], box->centre_m[1] - camera[1]);
  };
  std::sort(boxes.begin(), boxes.end(),
            [&](const Box* a, const Box* b) { return distance_m(a) > distance_m(b); });

  std::vector<Surface> surfaces{ground(camera)};
  for (const Box* const box : boxes) {
    const bool is_vehicle = box == &vehicle;
    const int id =
        is_vehicle ? kVehicleId : kObstacleId + kIdsPerBox * static_cast<int>(box - obstacles_.data());
    box->add_sides(camera, ground_texture_, id, surfaces);
    surfaces.push_back(is_vehicle ? deck_at(board, board_texture_)
                                  : box->top(ground_texture_, id + kBoxSides));
    if (!surfaces.back().faces(camera)) surfaces.pop_back();
  }
  return surfaces;
}

bool Scene::hides(const cv::Vec3d& camera, const cv::Vec3d& point) const {
  return std::any_of(obstacles_.begin(), obstacles_.end(),
                     [&](const Box& box) { return box.blocks(camera, point); });
}

}  // namespace esi
