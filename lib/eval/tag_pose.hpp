#pragma once

#include <map>
#include <optional>
#include <span>

#include "esi/core/pose.hpp"
#include "esi/core/truth.hpp"
#include "esi/eval/detection.hpp"
#include "esi/eval/pose_track.hpp"

namespace esi {

/// A tag in the camera's frame.
struct TagPose {
  Pose pose;
  double reprojection_error_px = 0.0;  ///< root mean square over the four corners
  /// The same of the other pose that a square has in an image (Collins & Bartoli 2014, IPPE). Where the two
  /// are alike, as for a tag seen frontally, the rotation may be the wrong one; the position hardly changes.
  double other_error_px = 0.0;
};

/// Throws a usage Error for a number of distortion coefficients that OpenCV doesn't have (0, 4, 5, 8, 12,
/// 14).
void require_usable(const CameraModel& camera);

/// From the corners in px (lower left, lower right, upper right, upper left) and the edge of the black square
/// in metres. Nothing for corners that no square in front of the camera has.
std::optional<TagPose> estimate_tag_pose(const std::array<double, 8>& corners_px, double size_m,
                                         const CameraModel& camera);

/// A tag on the target: its axes are parallel to the target's.
struct TargetTag {
  double size_m = 0.0;
  cv::Vec3d centre_m;  ///< in the target's frame
};

/// Where the tags sit on the target, from a truth that has corners, sizes, and both tracks: the median over
/// the rows where they are visible. A tag without size or without such a row is left out.
std::map<int, TargetTag> locate_tags(const TrueTags& tags, std::span<const TrueCorners> corners,
                                     const CameraModel& camera, const PoseTrack& camera_track,
                                     const PoseTrack& target_track);

}  // namespace esi
