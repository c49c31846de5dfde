#include "esi/recon/flow/common_motion.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <opencv2/core.hpp>
#include <random>

#include "esi/recon/flow/small_system.hpp"

using namespace esi;

namespace {

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

/// An affine motion of a grid, in px.
cv::Point2d affine(int x, int y) { return {0.7 - 0.05 * x + 0.02 * y, -0.4 + 0.03 * x + 0.06 * y}; }

/// Cells with edges of random directions, along which nothing is known, that want `wanted`.
CellSums edges(cv::Size grid, const std::function<cv::Point2d(int x, int y)>& wanted) {
  std::mt19937 random(3);
  CellSums sums;
  for (cv::Mat1f& sum : sums) sum = cv::Mat1f(grid, 0.0F);
  auto& [xx, xy, yy, rx, ry] = sums;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const double strength = 1e4 * uniform(random);
      const double angle = CV_PI * uniform(random);
      const cv::Point2d across(std::cos(angle), std::sin(angle));
      xx(y, x) = static_cast<float>(strength * across.x * across.x);
      xy(y, x) = static_cast<float>(strength * across.x * across.y);
      yy(y, x) = static_cast<float>(strength * across.y * across.y);
      const double known = strength * across.dot(wanted(x, y));
      rx(y, x) = static_cast<float>(known * across.x);
      ry(y, x) = static_cast<float>(known * across.y);
    }
  }
  return sums;
}

MotionField uniform_field(cv::Size grid, float x, float y) {
  return {cv::Mat1f(grid, x), cv::Mat1f(grid, y)};
}

}  // namespace

TEST_CASE("an affine motion is found from edges, and added to what each cell has") {
  for (const cv::Size grid : {cv::Size(22, 17), cv::Size(5, 9)}) {
    MotionField field = uniform_field(grid, 2.0F, -1.0F);
    field.x(1, 2) = 5.0F;
    add_common_motion(edges(grid, affine), field);
    CHECK(field.x(3, 4) == Approx(2.0 + affine(4, 3).x).margin(2e-3));
    CHECK(field.y(3, 4) == Approx(-1.0 + affine(4, 3).y).margin(2e-3));
    CHECK(field.x(4, 0) == Approx(2.0 + affine(0, 4).x).margin(2e-3));
    CHECK(field.x(1, 2) == Approx(5.0 + affine(2, 1).x).margin(2e-3));
  }
}

TEST_CASE("one cell that wants another motion doesn't move the others much") {
  const cv::Size grid(22, 17);
  MotionField field = uniform_field(grid, 0.0F, 0.0F);
  add_common_motion(
      edges(grid, [](int x, int y) { return x == 11 && y == 8 ? cv::Point2d(3, 3) : cv::Point2d(0, 0); }),
      field);
  CHECK(cv::norm(field.x, cv::NORM_INF) < 0.05);
}

TEST_CASE("without texture nothing moves, and a grid of one cell has a motion") {
  MotionField still = uniform_field({4, 3}, 0.5F, 0.25F);
  CellSums nothing;
  for (cv::Mat1f& sum : nothing) sum = cv::Mat1f(cv::Size(4, 3), 0.0F);
  add_common_motion(nothing, still);
  CHECK(cv::norm(still.x, cv::Mat1f(cv::Size(4, 3), 0.5F), cv::NORM_INF) == 0.0);

  MotionField one = uniform_field({1, 1}, 0.0F, 0.0F);
  CellSums sums;
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = cv::Mat1f(1, 1, i == 1 ? 0.0F : 1000.0F);
  add_common_motion(sums, one);
  CHECK(one.x(0) == Approx(1.0).margin(0.01));
  CHECK(one.y(0) == Approx(1.0).margin(0.01));
}

TEST_CASE("a small system is solved, as far as its unknowns are independent") {
  const cv::Mat1d matrix = (cv::Mat1d(3, 3) << 4.0, 2.0, 0.5, 2.0, 3.0, 1.0, 0.5, 1.0, 2.0);
  const std::vector<double> x = solve_small(matrix, {4.0 - 4.0 + 1.5, 2.0 - 6.0 + 3.0, 0.5 - 2.0 + 6.0});
  CHECK(x[0] == Approx(1.0));
  CHECK(x[1] == Approx(-2.0));
  CHECK(x[2] == Approx(3.0));
  const cv::Mat1d twice = (cv::Mat1d(2, 2) << 4.0, 4.0, 4.0, 4.0);
  CHECK(solve_small(twice, {12.0, 12.0}) == std::vector<double>{3.0, 0.0});
  CHECK(solve_small(cv::Mat1d(2, 2, 0.0), {0.0, 0.0}) == std::vector<double>{0.0, 0.0});
}
