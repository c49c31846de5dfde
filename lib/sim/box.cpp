#include "esi/sim/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "esi/sim/ground.hpp"

namespace esi {
namespace {

const cv::Vec3d kUp(0, 0, 1);
/// Light comes from above and a little from one side.
constexpr std::array<float, kBoxSides> kShade{0.7F, 0.5F, 0.4F, 0.6F};

cv::Vec3d on_ground(const cv::Vec2d& point) { return {point[0], point[1], 0.0}; }

}  // namespace

cv::Vec3d Box::length_axis() const { return {std::cos(heading_rad), std::sin(heading_rad), 0.0}; }
cv::Vec3d Box::width_axis() const { return {-std::sin(heading_rad), std::cos(heading_rad), 0.0}; }

void Box::add_sides(const cv::Vec3d& viewer, const Texture& texture, int first_id,
                    std::vector<Surface>& out) const {
  const std::array<cv::Vec3d, 2> axes{length_axis(), width_axis()};
  std::array<Surface, kBoxSides> sides;
  std::array<bool, kBoxSides> is_seen{};
  for (std::size_t i = 0; i < kBoxSides; ++i) {  // each side is right of the one before, seen from outside
    const cv::Vec3d outward = (i < 2 ? 1.0 : -1.0) * axes[i % 2];
    const cv::Vec3d right = kUp.cross(outward);
    const double reach_m = half_m[static_cast<int>(i % 2)];
    const double half_width_m = half_m[static_cast<int>((i + 1) % 2)];
    const cv::Vec2d begin = texture_offset;
    const cv::Vec2d end = begin + cv::Vec2d(2 * half_width_m, height_m) / kGroundTexel_m;
    Surface& side = sides[i];
    side.id = first_id + static_cast<int>(i);
    side.texture = &texture;
    side.gain = gain * kShade[i];
    side.along_u = kGroundTexel_m * right;
    side.along_v = -kGroundTexel_m * kUp;
    side.origin = on_ground(centre_m) + reach_m * outward - half_width_m * right + height_m * kUp -
                  begin[0] * side.along_u - begin[1] * side.along_v;
    side.corners = {begin, {end[0], begin[1]}, end, {begin[0], end[1]}};
    side.runs_under[0] = viewer[2] > height_m;
    is_seen[i] = side.faces(viewer);
  }
  const auto is_under_next = [&](std::size_t i) { return is_seen[(i + 1) % kBoxSides]; };
  for (const bool under_next : {true, false}) {
    for (std::size_t i = 0; i < kBoxSides; ++i) {
      if (!is_seen[i] || is_under_next(i) != under_next) continue;
      sides[i].runs_under[1] = under_next;
      out.push_back(sides[i]);
    }
  }
}

Surface Box::top(const Texture& texture, int id) const {
  Surface top;
  top.id = id;
  top.texture = &texture;
  top.gain = gain;
  top.along_u = kGroundTexel_m * length_axis();
  top.along_v = -kGroundTexel_m * width_axis();
  const cv::Vec2d half = half_m / kGroundTexel_m;
  const cv::Vec2d middle = texture_offset + half;
  top.origin = on_ground(centre_m) + height_m * kUp - middle[0] * top.along_u - middle[1] * top.along_v;
  top.corners = {middle - half,
                 {middle[0] + half[0], middle[1] - half[1]},
                 middle + half,
                 {middle[0] - half[0], middle[1] + half[1]}};
  return top;
}

bool Box::blocks(const cv::Vec3d& from, const cv::Vec3d& to) const {
  // The share of the line within all three pairs of planes (slabs) is not empty.
  const cv::Vec3d centre = on_ground(centre_m) + 0.5 * height_m * kUp;
  const std::array<cv::Vec3d, 3> axes{length_axis(), width_axis(), kUp};
  const std::array<double, 3> halves{half_m[0], half_m[1], 0.5 * height_m};
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double begin = (from - centre).dot(axes[i]);
    const double way = (to - from).dot(axes[i]);
    if (std::abs(way) < 1e-12) {
      if (std::abs(begin) > halves[i]) return false;
      continue;
    }
    const double a = (-halves[i] - begin) / way;
    const double b = (halves[i] - begin) / way;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters < leaves;
}

}  // namespace esi
