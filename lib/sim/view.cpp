#include "esi/sim/view.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

namespace esi {
namespace {

constexpr double kNear_m = 0.01;

/// A corner of a polygon, and whether the edge that begins there runs under.
template <class Point>
struct Corner {
  Point point;
  bool runs_under = false;
};

/// The part of a convex polygon where distance(point) >= 0 (Sutherland & Hodgman 1974).
template <class Point, class Distance>
std::vector<Corner<Point>> clipped(const std::vector<Corner<Point>>& polygon, Distance distance) {
  std::vector<Corner<Point>> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner<Point>& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()].point;
    const double da = distance(a.point);
    const double db = distance(b);
    if (da >= 0.0) inside.push_back(a);
    if ((da >= 0.0) == (db >= 0.0)) continue;
    const bool leaves = da >= 0.0;
    inside.push_back({a.point + da / (da - db) * (b - a.point), leaves ? false : a.runs_under});
  }
  return inside;
}

std::vector<cv::Vec2d> clipped_to_sensor(const std::vector<cv::Vec2d>& vertices, SensorSize size) {
  std::vector<Corner<cv::Vec2d>> polygon;
  for (const cv::Vec2d& vertex : vertices) polygon.push_back({vertex});
  polygon = clipped(polygon, [](const cv::Vec2d& p) { return p[0] + 0.5; });
  polygon = clipped(polygon, [](const cv::Vec2d& p) { return p[1] + 0.5; });
  polygon = clipped(polygon, [size](const cv::Vec2d& p) { return size.width_px - 0.5 - p[0]; });
  polygon = clipped(polygon, [size](const cv::Vec2d& p) { return size.height_px - 0.5 - p[1]; });
  std::vector<cv::Vec2d> points;
  for (const auto& corner : polygon) points.push_back(corner.point);
  return points;
}

bool touches_sensor(const std::vector<cv::Vec2d>& vertices, SensorSize size) {
  const auto all = [&](auto is_outside) { return std::all_of(vertices.begin(), vertices.end(), is_outside); };
  return !vertices.empty() && !all([](const cv::Vec2d& p) { return p[0] < -1.0; }) &&
         !all([](const cv::Vec2d& p) { return p[1] < -1.0; }) &&
         !all([size](const cv::Vec2d& p) { return p[0] > size.width_px; }) &&
         !all([size](const cv::Vec2d& p) { return p[1] > size.height_px; });
}

void add_edges(const std::vector<Corner<cv::Vec2d>>& polygon, ProjectedSurface& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const cv::Vec2d& from = polygon[i].point;
    const cv::Vec2d way = polygon[(i + 1) % polygon.size()].point - from;
    const double length = std::hypot(way[0], way[1]);
    if (length < 1e-9) continue;
    const double a = -way[1] / length;  // corners go round clockwise, so inside is on the right
    const double b = way[0] / length;
    out.edges.push_back({a, b, -(a * from[0] + b * from[1]) + (polygon[i].runs_under ? 1.0 : 0.0)});
  }
}

std::optional<ProjectedSurface> project(const Surface& surface, const Pose& to_camera, const Camera& camera) {
  std::vector<Corner<cv::Vec3d>> corners;
  for (std::size_t i = 0; i < surface.corners.size(); ++i) {
    corners.push_back({to_camera * surface.at(surface.corners[i]), surface.runs_under[i]});
  }
  corners = clipped(corners, [](const cv::Vec3d& p) { return p[2] - kNear_m; });

  ProjectedSurface projected{surface.id, surface.texture, surface.gain, {}, {}, {}, {}};
  std::vector<Corner<cv::Vec2d>> polygon;
  for (const auto& corner : corners) {
    polygon.push_back({camera.project(corner.point), corner.runs_under});
    projected.vertices.push_back(polygon.back().point);
  }
  if (!touches_sensor(projected.vertices, camera.size)) return std::nullopt;
  add_edges(polygon, projected);

  const cv::Vec3d u = to_camera.rotation * surface.along_u;
  const cv::Vec3d v = to_camera.rotation * surface.along_v;
  const cv::Vec3d o = to_camera * surface.origin;
  projected.to_pixel = camera.matrix() * cv::Matx33d(u[0], v[0], o[0], u[1], v[1], o[1], u[2], v[2], o[2]);
  projected.to_texel = projected.to_pixel.inv();
  return projected;
}

}  // namespace

View project(const std::vector<Surface>& surfaces, const Pose& camera_pose, const Camera& camera) {
  const Pose to_camera = camera_pose.inverse();
  View view;
  for (const Surface& surface : surfaces) {
    if (auto projected = project(surface, to_camera, camera)) view.push_back(std::move(*projected));
  }
  return view;
}

double largest_motion_px(const View& from, const View& to, SensorSize size) {
  double largest = 0.0;
  for (const ProjectedSurface& surface : from) {
    const auto later = std::find_if(to.begin(), to.end(),
                                    [&](const ProjectedSurface& other) { return other.id == surface.id; });
    if (later == to.end()) continue;
    for (const cv::Vec2d& point : clipped_to_sensor(surface.vertices, size)) {
      const cv::Vec2d moved = mapped(later->to_pixel, mapped(surface.to_texel, point));
      largest = std::max(largest, cv::norm(moved - point));
    }
  }
  return largest;
}

}  // namespace esi
