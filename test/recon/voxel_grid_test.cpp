#include "esi/recon/voxel_grid.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

using namespace esi;

namespace {

constexpr SensorSize kSize{3, 3};

float at(const cv::Mat& grid, int bin, int y, int x) { return grid.ptr<float>(0, bin)[y * grid.size[3] + x]; }

double total(const cv::Mat& grid) {
  double sum = 0.0;
  for (std::size_t i = 0; i < grid.total(); ++i) sum += static_cast<double>(grid.ptr<float>()[i]);
  return sum;
}

}  // namespace

TEST_CASE("voxel grid: an event is shared between the two bins next to its time") {
  // From 100 to 180 us in 5 bins: one every 20 us.
  const std::vector<Event> events{{100, 0, 0, true}, {105, 1, 0, true},  {130, 2, 1, false},
                                  {160, 1, 2, true}, {175, 1, 0, false}, {180, 2, 2, true}};
  cv::Mat grid;
  fill_voxel_grid(events, {}, 5, kSize, grid);
  REQUIRE(grid.dims == 4);
  REQUIRE(std::vector<int>(grid.size.p, grid.size.p + 4) == std::vector<int>{1, 5, 3, 3});
  CHECK(at(grid, 0, 0, 0) == 1.0F);
  CHECK(at(grid, 0, 0, 1) == 0.75F);
  CHECK(at(grid, 1, 0, 1) == 0.25F);
  CHECK(at(grid, 1, 1, 2) == -0.5F);
  CHECK(at(grid, 2, 1, 2) == -0.5F);
  CHECK(at(grid, 3, 2, 1) == 1.0F);
  CHECK(at(grid, 3, 0, 1) == -0.25F);
  CHECK(at(grid, 4, 0, 1) == -0.75F);
  CHECK(at(grid, 4, 2, 2) == 1.0F);
  CHECK(total(grid) == 2.0);
  CHECK(cv::countNonZero(grid.reshape(1, 1)) == 9);
}

TEST_CASE("voxel grid: weights multiply polarities, and what stood there before is gone") {
  const std::vector<Event> events{{0, 0, 0, true}, {40, 1, 1, false}, {40, 1, 1, false}};
  const std::vector<float> weights{0.5F, 2.0F, 0.25F};
  cv::Mat grid;
  fill_voxel_grid({{{0, 2, 2, true}}}, {}, 3, kSize, grid);
  fill_voxel_grid(events, weights, 3, kSize, grid);
  CHECK(at(grid, 0, 0, 0) == 0.5F);
  CHECK(at(grid, 2, 1, 1) == -2.25F);
  CHECK(total(grid) == -1.75);
}

TEST_CASE("voxel grid: events at one time go into the first bin, and a lone bin takes all") {
  const std::vector<Event> at_once{{7, 0, 1, true}, {7, 0, 1, true}, {7, 2, 2, false}};
  cv::Mat grid;
  fill_voxel_grid(at_once, {}, 5, kSize, grid);
  CHECK(at(grid, 0, 1, 0) == 2.0F);
  CHECK(at(grid, 0, 2, 2) == -1.0F);
  CHECK(cv::countNonZero(grid.reshape(1, 1)) == 2);
  fill_voxel_grid({{{0, 0, 0, true}, {9, 0, 0, true}}}, {}, 1, kSize, grid);
  CHECK(at(grid, 0, 0, 0) == 2.0F);
  fill_voxel_grid({}, {}, 5, kSize, grid);
  CHECK(total(grid) == 0.0);
}

TEST_CASE("voxel grid: times far from 0 lose nothing") {
  constexpr std::int64_t kFar_us = std::numeric_limits<std::int64_t>::max() - 100;
  cv::Mat near;
  cv::Mat far;
  fill_voxel_grid({{{0, 0, 0, true}, {3, 1, 1, true}, {7, 2, 2, false}}}, {}, 5, kSize, near);
  fill_voxel_grid({{{kFar_us, 0, 0, true}, {kFar_us + 3, 1, 1, true}, {kFar_us + 7, 2, 2, false}}}, {}, 5,
                  kSize, far);
  CHECK(cv::norm(near.reshape(1, 1), far.reshape(1, 1), cv::NORM_INF) == 0.0);
}

TEST_CASE("normalisation gives what isn't 0 the mean 0 and the deviation 1, and leaves 0") {
  cv::Mat grid;
  // Entries 1, 1, 1, -1, and 0 elsewhere: mean 0.5, deviation sqrt(0.75).
  fill_voxel_grid({{{0, 0, 0, true}, {0, 1, 0, true}, {0, 2, 0, true}, {0, 0, 1, false}}}, {}, 2, kSize,
                  grid);
  normalise_non_zero(grid);
  CHECK(at(grid, 0, 0, 0) == Approx(0.5 / std::sqrt(0.75)));
  CHECK(at(grid, 0, 0, 2) == Approx(0.5 / std::sqrt(0.75)));
  CHECK(at(grid, 0, 1, 0) == Approx(-1.5 / std::sqrt(0.75)));
  CHECK(cv::countNonZero(grid.reshape(1, 1)) == 4);
}

TEST_CASE("normalisation of equal entries, or of none, gives zeros and not infinities") {
  cv::Mat grid;
  fill_voxel_grid({{{0, 0, 0, true}, {0, 1, 1, true}}}, {}, 2, kSize, grid);
  normalise_non_zero(grid);
  CHECK(cv::countNonZero(grid.reshape(1, 1)) == 0);
  normalise_non_zero(grid);
  CHECK(cv::countNonZero(grid.reshape(1, 1)) == 0);
}
