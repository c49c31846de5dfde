#include "esi/recon/steps/undistortion.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace esi {
namespace {

double coefficient(const CameraCalibration& camera, std::size_t i) {
  return i < camera.distortion.size() ? camera.distortion[i] : 0.0;
}

cv::Point2d radial_tangential(const CameraCalibration& camera, cv::Point2d point) {
  const auto k = [&camera](std::size_t i) { return coefficient(camera, i); };
  const auto [x, y] = point;
  const double r2 = x * x + y * y;
  const double p1 = k(2);
  const double p2 = k(3);
  const double radial =
      (1.0 + r2 * (k(0) + r2 * (k(1) + r2 * k(4)))) / (1.0 + r2 * (k(5) + r2 * (k(6) + r2 * k(7))));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

cv::Point2d equidistant(const CameraCalibration& camera, cv::Point2d point) {
  const auto k = [&camera](std::size_t i) { return coefficient(camera, i); };
  const double r = std::hypot(point.x, point.y);
  if (r == 0.0) return point;
  const double theta = std::atan(r);
  const double t2 = theta * theta;
  return point * (theta * (1.0 + t2 * (k(0) + t2 * (k(1) + t2 * (k(2) + t2 * k(3))))) / r);
}

}  // namespace

cv::Point2d distorted(const CameraCalibration& camera, cv::Point2d point) {
  return camera.model == LensModel::equidistant ? equidistant(camera, point)
                                                : radial_tangential(camera, point);
}

Undistortion::Undistortion(const CameraCalibration& camera, SensorSize size, cv::Point corner)
    : source_px_(size.height_px, size.width_px) {
  const cv::Point2d centre(camera.cx - corner.x, camera.cy - corner.y);
  for (int v = 0; v < size.height_px; ++v) {
    for (int u = 0; u < size.width_px; ++u) {
      const cv::Point2d point = distorted(camera, {(u - centre.x) / camera.fx, (v - centre.y) / camera.fy});
      source_px_(v, u) = {static_cast<float>(point.x * camera.fx + centre.x),
                          static_cast<float>(point.y * camera.fy + centre.y)};
    }
  }
}

void Undistortion::apply(cv::Mat1f& levels) {
  cv::remap(levels, straight_, source_px_, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0.0));
  cv::swap(levels, straight_);
}

}  // namespace esi
