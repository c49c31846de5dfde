#include <catch2/catch.hpp>

#include "esi/recon/flow/bilinear_row.hpp"
#include "esi/recon/flow/cell_grid.hpp"
#include "esi/recon/flow/cell_smoothing.hpp"
#include "esi/recon/flow/double_size.hpp"
#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "recon/flow/random_problems.hpp"
#include "recon/flow/textures.hpp"

using namespace esi;
using namespace esi::test;

TEST_CASE("a row is looked up bilinearly, and the border goes on outside") {
  const cv::Size size(21, 9);
  const auto plane = [](double x, double y) { return 1.0 + 3.0 * x - 2.0 * y; };
  const cv::Mat1f image = image_of(size, plane);
  BilinearRow row(size);
  const cv::Mat1f vx = random_image({size.width, 1}, 1, 6.0);
  const cv::Mat1f vy = random_image({size.width, 1}, 2, 6.0);
  std::vector<float> out(21);
  for (const float offset : {0.0F, 0.5F}) {
    for (int y = 0; y < size.height; ++y) {
      row.place(y, vx[0], vy[0], 0.7F, offset);
      row.sample(image, out.data());
      for (int x = 0; x < size.width; ++x) {
        const double at_x = std::clamp(x + double{offset} - 0.7 * double{vx(x)}, 0.0, 20.0);
        const double at_y = std::clamp(y + double{offset} - 0.7 * double{vy(x)}, 0.0, 8.0);
        CHECK(out[static_cast<std::size_t>(x)] == Approx(plane(at_x, at_y)).margin(1e-3));
      }
    }
  }
}

TEST_CASE("smooth motion is looked up as any other, also in images of one row or column") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 1), cv::Size(75, 4)}) {
    const cv::Mat1f image = random_image(size, 7);
    const auto pixel = [&](int x, int y) {
      return double{image(std::clamp(y, 0, size.height - 1), std::clamp(x, 0, size.width - 1))};
    };
    BilinearRow row(size);
    std::vector<float> vx, vy, out(static_cast<std::size_t>(size.width));
    for (int x = 0; x < size.width; ++x) {
      // Runs of one shift that end anywhere.
      vx.push_back(0.6F + 0.07F * static_cast<float>(x));
      vy.push_back(x < 40 ? -0.4F : 0.8F);
    }
    for (int y = 0; y < size.height; ++y) {
      row.place(y, vx.data(), vy.data(), 1.0F);
      row.sample(image, out.data());
      for (int x = 0; x < size.width; ++x) {
        const auto i = static_cast<std::size_t>(x);
        const double at_x = x - double{vx[i]};
        const double at_y = y - double{vy[i]};
        const int left = static_cast<int>(std::floor(at_x));
        const int above = static_cast<int>(std::floor(at_y));
        const double upper =
            pixel(left, above) + (at_x - left) * (pixel(left + 1, above) - pixel(left, above));
        const double lower =
            pixel(left, above + 1) + (at_x - left) * (pixel(left + 1, above + 1) - pixel(left, above + 1));
        CHECK(double{out[i]} == Approx(upper + (at_y - above) * (lower - upper)).margin(1e-4));
      }
    }
  }
}

TEST_CASE("cells hold a plane's values between their centres, and the nearest outside them") {
  const cv::Size size(100, 50);
  for (const double cell_px : {16.0, 8.0, 7.0}) {
    CellGrid grid(size, cell_px);
    CHECK(grid.size() ==
          cv::Size(static_cast<int>(std::ceil(100 / cell_px)), static_cast<int>(std::ceil(50 / cell_px))));
    const cv::Mat1f cells =
        image_of(grid.size(), [&](int x, int y) { return 2.0 * (x + 0.5) * cell_px - (y + 0.5) * cell_px; });
    std::vector<float> out(100);
    const auto within = [&](double at, int count) {
      return std::clamp(at, 0.5 * cell_px, (count - 0.5) * cell_px);
    };
    for (int y = 0; y < size.height; ++y) {
      grid.interpolate_row(cells, y, 0.5F, out.data());
      for (int x = 0; x < size.width; ++x) {
        const double expected =
            within(x + 0.5, grid.size().width) - 0.5 * within(y + 0.5, grid.size().height);
        CHECK(out[static_cast<std::size_t>(x)] == Approx(expected).margin(1e-3));
      }
    }
    CHECK(grid.cell_of(0) == 0);
    CHECK(grid.cell_of(static_cast<int>(cell_px) - 1) == 0);
    CHECK(grid.cell_of(static_cast<int>(cell_px)) == 1);
  }
}

TEST_CASE("half the size sums by twos, an odd border counting twice") {
  const cv::Mat1f image = (cv::Mat1f(3, 5) << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  cv::Mat1f half;
  sum_by_twos(image, 0.25F, half);
  const cv::Mat1f expected = (cv::Mat1f(2, 3) << 4, 6, 7.5, 11.5, 13.5, 15);
  CHECK(cv::norm(half, expected) == 0.0);
  sum_by_twos(cv::Mat1f(1, 1, 3.0F), 1.0F, half);
  CHECK(half.size() == cv::Size(1, 1));
  CHECK(half(0) == 12.0F);
}

TEST_CASE("a cell may be larger than the image, or a pixel") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(5, 3)}) {
    for (const double cell_px : {16.0, 1.0}) {
      CellGrid grid(size, cell_px);
      const cv::Mat1f cells = random_image(grid.size(), 8);
      std::vector<float> out(static_cast<std::size_t>(size.width));
      for (int y = 0; y < size.height; ++y) {
        grid.interpolate_row(cells, y, 2.0F, out.data());
        for (int x = 0; x < size.width; ++x)
          CHECK(out[static_cast<std::size_t>(x)] == 2.0F * cells(grid.cell_of(y), grid.cell_of(x)));
      }
    }
  }
}

TEST_CASE("cells are smoothed by 1 2 1 both ways, and the border goes on outside") {
  cv::Mat1f cells(3, 4, 0.0F);
  cells(1, 1) = 16.0F;
  smooth_cells(cells);
  const cv::Mat1f within = (cv::Mat1f(3, 4) << 1, 2, 1, 0, 2, 4, 2, 0, 1, 2, 1, 0);
  CHECK(cv::norm(cells, within) == 0.0);
  cells.setTo(0.0F);
  cells(0, 3) = 16.0F;
  smooth_cells(cells);
  const cv::Mat1f at_corner = (cv::Mat1f(3, 4) << 0, 0, 3, 9, 0, 0, 1, 3, 0, 0, 0, 0);
  CHECK(cv::norm(cells, at_corner) == 0.0);
  cv::Mat1f single(1, 1, 3.0F);
  smooth_cells(single);
  CHECK(single(0) == 3.0F);
}

TEST_CASE("the mean of a cell's neighbours leaves out the cell, but where it goes on outside") {
  const cv::Mat1f cells = (cv::Mat1f(2, 3) << 4, 8, 12, 16, 20, 24);
  const cv::Mat1f expected = (cv::Mat1f(2, 3) << 8, 11, 14, 14, 17, 20);
  CHECK(cv::norm(mean_of_neighbours(cells), expected) == 0.0);
}

TEST_CASE("twice the size lies a quarter of a pixel beside, and the border goes on outside") {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 2), cv::Size(9, 6), cv::Size(46, 33)}) {
    const cv::Mat1f coarse = random_image(half_of(size), 9);
    DoubleSize doubled(coarse);
    std::vector<float> out(static_cast<std::size_t>(size.width) + 1, 5.0F);
    for (int y = 0; y < size.height; ++y) {
      doubled.row(y, size.width, out.data());
      for (int x = 0; x < size.width; ++x) {
        const double at_x = std::clamp(0.5 * x - 0.25, 0.0, coarse.cols - 1.0);
        const double at_y = std::clamp(0.5 * y - 0.25, 0.0, coarse.rows - 1.0);
        const int left = std::min(static_cast<int>(at_x), std::max(coarse.cols - 2, 0));
        const int above = std::min(static_cast<int>(at_y), std::max(coarse.rows - 2, 0));
        const int right = std::min(left + 1, coarse.cols - 1);
        const int below = std::min(above + 1, coarse.rows - 1);
        const auto along = [&](int row) {
          return double{coarse(row, left)} +
                 (at_x - left) * (double{coarse(row, right)} - double{coarse(row, left)});
        };
        CHECK(double{out[static_cast<std::size_t>(x)]} ==
              Approx(along(above) + (at_y - above) * (along(below) - along(above))).margin(1e-5));
      }
      CHECK(out.back() == 5.0F);
    }
  }
}

TEST_CASE("a sum of products of any length") {
  const cv::Mat1f a = random_image({100, 1}, 5);
  const cv::Mat1f b = random_image({100, 1}, 6);
  for (const int count : {0, 1, 31, 32, 33, 100}) {
    double expected = 0.0;
    for (int i = 0; i < count; ++i) expected += static_cast<double>(a(i)) * static_cast<double>(b(i));
    CHECK(dot(a[0], b[0], count) == Approx(expected).margin(1e-5));
  }
}
