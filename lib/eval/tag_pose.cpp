#include "esi/eval/tag_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/eval/statistics.hpp"

namespace esi {
namespace {

/// In the tag's frame, in the order that OpenCV's SOLVEPNP_IPPE_SQUARE asks for; with y down it is ours, too.
std::vector<cv::Point3d> square_corners(double size_m) {
  const double h = size_m / 2.0;
  return {{-h, h, 0.0}, {h, h, 0.0}, {h, -h, 0.0}, {-h, -h, 0.0}};
}

bool is_finite(const Pose& pose) {
  return cv::checkRange(pose.rotation) && std::isfinite(cv::norm(pose.position_m));
}

}  // namespace

void require_usable(const CameraModel& camera) {
  constexpr std::array<std::size_t, 6> known{0, 4, 5, 8, 12, 14};
  if (std::find(known.begin(), known.end(), camera.distortion.size()) != known.end()) return;
  throw usage_error(
      fmt::format("the camera has {} distortion coefficients; give 0, 4, 5, 8, 12 or 14, in OpenCV's order",
                  camera.distortion.size()));
}

std::optional<TagPose> estimate_tag_pose(const std::array<double, 8>& corners_px, double size_m,
                                         const CameraModel& camera) {
  require_usable(camera);
  std::vector<cv::Point2d> image;
  for (std::size_t k = 0; k < 4; ++k) image.emplace_back(corners_px[2 * k], corners_px[2 * k + 1]);
  if (!cv::checkRange(image)) return std::nullopt;
  const cv::Matx33d matrix{camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  std::vector<cv::Vec3d> rotations, positions;
  std::vector<double> errors_px;
  try {
    cv::solvePnPGeneric(square_corners(size_m), image, matrix, camera.distortion, rotations, positions, false,
                        cv::SOLVEPNP_IPPE_SQUARE, cv::noArray(), cv::noArray(), errors_px);
  } catch (const cv::Exception&) {  // its homography does not exist: corners on one line or in one point
    return std::nullopt;
  }
  if (positions.empty()) return std::nullopt;
  TagPose result{{{}, positions[0]}, errors_px[0], errors_px.back()};
  cv::Rodrigues(rotations[0], result.pose.rotation);
  if (!is_finite(result.pose) || !(positions[0][2] > 0.0)) return std::nullopt;
  return result;
}

std::map<int, TargetTag> locate_tags(const TrueTags& tags, std::span<const TrueCorners> corners,
                                     const CameraModel& camera, const PoseTrack& camera_track,
                                     const PoseTrack& target_track) {
  std::map<int, std::array<std::vector<double>, 3>> places_m;
  for (const TrueCorners& row : corners) {
    const auto size = tags.size_m.find(row.id);
    if (!row.visible || size == tags.size_m.end()) continue;
    const auto tag = estimate_tag_pose(row.xy_px, size->second, camera);
    const auto eye = camera_track.at(row.t_us), target = target_track.at(row.t_us);
    if (!tag || !eye || !target) continue;
    const cv::Vec3d place = target->inverse() * (*eye * tag->pose.position_m);
    for (std::size_t axis = 0; axis < 3; ++axis)
      places_m[row.id][axis].push_back(place[static_cast<int>(axis)]);
  }
  std::map<int, TargetTag> located;
  for (const auto& [id, axes] : places_m) {
    located[id] = {tags.size_m.at(id), {*median(axes[0]), *median(axes[1]), *median(axes[2])}};
  }
  return located;
}

}  // namespace esi
