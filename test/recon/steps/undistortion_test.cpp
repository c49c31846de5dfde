#include "esi/recon/steps/undistortion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>

using namespace esi;

namespace {

constexpr SensorSize kSize{80, 60};

CameraCalibration camera(LensModel model, std::vector<double> distortion) {
  return {kSize, 50.0, 55.0, 41.0, 29.0, model, std::move(distortion)};
}

/// The levels at a pixel are a smooth function of where it looks, so an undistorted image is known
/// everywhere.
float level_at(cv::Point2d point) { return static_cast<float>(100.0 + 60.0 * point.x - 40.0 * point.y); }

/// What the distorted camera sees of level_at: for every pixel the point whose distorted image it is, by
/// fixed-point iteration.
cv::Mat1f seen_by(const CameraCalibration& lens) {
  cv::Mat1f levels(kSize.height_px, kSize.width_px);
  for (int v = 0; v < levels.rows; ++v) {
    for (int u = 0; u < levels.cols; ++u) {
      const cv::Point2d target((u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy);
      cv::Point2d point = target;
      for (int i = 0; i < 200; ++i) point += target - distorted(lens, point);
      levels(v, u) = level_at(point);
    }
  }
  return levels;
}

}  // namespace

TEST_CASE("a lens without distortion changes nothing") {
  const auto model = GENERATE(LensModel::radial_tangential);
  cv::Mat1f levels = seen_by(camera(model, {}));
  const cv::Mat1f before = levels.clone();
  Undistortion(camera(model, {}), kSize).apply(levels);
  CHECK(cv::norm(levels, before, cv::NORM_INF) < 1e-3);
}

TEST_CASE("radial and tangential distortion are those of the textbook") {
  const auto lens = camera(LensModel::radial_tangential, {0.1, 0.02, 0.003, -0.004, 0.005});
  const cv::Point2d p = distorted(lens, {0.5, -0.2});
  // r2 = 0.29, radial = 1 + 0.1*0.29 + 0.02*0.0841 + 0.005*0.024389 = 1.030803945
  CHECK(p.x == Approx(0.5 * 1.030803945 + 2 * 0.003 * 0.5 * -0.2 + -0.004 * (0.29 + 2 * 0.25)));
  CHECK(p.y == Approx(-0.2 * 1.030803945 + 0.003 * (0.29 + 2 * 0.04) + 2 * -0.004 * 0.5 * -0.2));
}

TEST_CASE("a rational model divides by its second polynomial") {
  const auto lens = camera(LensModel::radial_tangential, {0, 0, 0, 0, 0, 0.2, 0.1, 0.3});
  CHECK(distorted(lens, {1.0, 0.0}).x == Approx(1.0 / 1.6));
}

TEST_CASE("an equidistant lens maps angles to radii") {
  const auto plain = camera(LensModel::equidistant, {});
  CHECK(distorted(plain, {1.0, 0.0}).x == Approx(std::atan(1.0)));
  CHECK(distorted(plain, {0.0, 0.0}).x == 0.0);
  const auto bent = camera(LensModel::equidistant, {0.1, 0.2, 0.3, 0.4});
  const double t = std::atan(0.5);
  const double expected =
      t + 0.1 * std::pow(t, 3) + 0.2 * std::pow(t, 5) + 0.3 * std::pow(t, 7) + 0.4 * std::pow(t, 9);
  CHECK(distorted(bent, {0.3, 0.4}).x == Approx(expected * 0.6));
  CHECK(distorted(bent, {0.3, 0.4}).y == Approx(expected * 0.8));
}

TEST_CASE("an undistorted image is what a pinhole camera sees, also of a region of the sensor") {
  const auto lens = GENERATE(camera(LensModel::radial_tangential, {-0.2, 0.05, 0.002, -0.001, 0.0}),
                             camera(LensModel::equidistant, {0.01, 0.02}));
  cv::Mat1f levels = seen_by(lens);
  const cv::Rect region(10, 5, 60, 50);
  cv::Mat1f part = levels(region).clone();
  Undistortion(lens, kSize).apply(levels);
  Undistortion(lens, {region.width, region.height}, region.tl()).apply(part);
  for (int v = 12; v < 48; ++v) {
    for (int u = 18; u < 64; ++u) {
      const float expected = level_at({(u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy});
      REQUIRE(levels(v, u) == Approx(expected).margin(0.2));
      REQUIRE(part(v - region.y, u - region.x) == Approx(expected).margin(0.2));
    }
  }
}

TEST_CASE("what lies outside the sensor is black") {
  cv::Mat1f levels(kSize.height_px, kSize.width_px, 200.0F);
  Undistortion(camera(LensModel::radial_tangential, {0.5}), kSize).apply(levels);
  CHECK(levels(0, 0) == 0.0F);
  CHECK(levels(29, 41) == 200.0F);
}
