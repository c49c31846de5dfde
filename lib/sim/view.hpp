#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/pose.hpp"
#include "esi/sim/camera.hpp"
#include "esi/sim/surface.hpp"

namespace esi {

/// A surface as it falls on the sensor.
struct ProjectedSurface {
  /// a x + b y + c is the distance in px from the edge's line, positive inside.
  struct Edge {
    double a, b, c;
    double at(double x, double y) const { return a * x + b * y + c; }
  };

  int id = 0;
  const Texture* texture = nullptr;
  float gain = 1.0F;
  cv::Matx33d to_texel, to_pixel;   ///< homographies between pixels (x, y, 1) and texels (u, v, 1)
  std::vector<cv::Vec2d> vertices;  ///< px; convex, in front of the camera
  std::vector<Edge> edges;
};

/// What the camera sees at one moment, in drawing order.
using View = std::vector<ProjectedSurface>;

/// Projects surfaces given in drawing order; those that can't be on the sensor are left out.
View project(const std::vector<Surface>& surfaces, const Pose& camera_pose, const Camera& camera);

/// How far the image of anything on the sensor moves from one view to the other, in px (at the corners of
/// what is visible of each surface).
double largest_motion_px(const View& from, const View& to, SensorSize size);

/// The point that a homography takes (x, y) to.
inline cv::Vec2d mapped(const cv::Matx33d& homography, const cv::Vec2d& point) {
  const cv::Vec3d p = homography * cv::Vec3d(point[0], point[1], 1.0);
  return {p[0] / p[2], p[1] / p[2]};
}

}  // namespace esi
