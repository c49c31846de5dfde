#include "esi/recon/network_image.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

using namespace esi;

namespace {

std::array<int, 4> padding_of(SensorSize size, int multiple_px) {
  const Padding padding = Padding::to_multiple(size, multiple_px);
  return {padding.top, padding.bottom, padding.left, padding.right};
}

cv::Mat1f row(const std::vector<float>& values) { return cv::Mat1f(values, true).reshape(1, 1); }

double distance(const cv::Mat1f& a, const cv::Mat1f& b) { return cv::norm(a, b, cv::NORM_INF); }

}  // namespace

TEST_CASE("padding reaches the next multiple, more of it above and on the left") {
  CHECK(padding_of({346, 260}, 16) == std::array{6, 6, 3, 3});
  CHECK(padding_of({346, 260}, 8) == std::array{2, 2, 3, 3});
  CHECK(padding_of({241, 177}, 8) == std::array{4, 3, 4, 3});
  CHECK(padding_of({16, 32}, 16) == std::array{0, 0, 0, 0});
  CHECK(padding_of({1, 17}, 16) == std::array{8, 7, 8, 7});
  CHECK(padding_of({5, 7}, 1) == std::array{0, 0, 0, 0});
}

TEST_CASE("padding mirrors around the border pixels, channel by channel") {
  const std::array<int, 4> shape{1, 2, 3, 3};
  cv::Mat grid(4, shape.data(), CV_32F);
  for (int i = 0; i < 18; ++i) grid.ptr<float>()[i] = static_cast<float>(i);
  cv::Mat padded;
  pad_reflected(grid, {2, 1, 1, 2}, padded);
  REQUIRE(std::vector<int>(padded.size.p, padded.size.p + 4) == std::vector<int>{1, 2, 6, 6});
  // 0 1 2 / 3 4 5 / 6 7 8, rows 2 1 | 0 1 2 | 1 and columns 1 | 0 1 2 | 1 0
  const cv::Mat1f expected = (cv::Mat1f(6, 6) << 7, 6, 7, 8, 7, 6, 4, 3, 4, 5, 4, 3, 1, 0, 1, 2, 1, 0, 4, 3,
                              4, 5, 4, 3, 7, 6, 7, 8, 7, 6, 4, 3, 4, 5, 4, 3);
  for (int channel = 0; channel < 2; ++channel) {
    cv::Mat1f of_channel;
    expected.convertTo(of_channel, CV_32F, 1.0, 9.0 * channel);
    CHECK(distance(cv::Mat1f(6, 6, padded.ptr<float>(0, channel)), of_channel) == 0.0);
  }
  const cv::Mat1f middle = without_padding(cv::Mat1f(6, 6, padded.ptr<float>(0, 1)), {2, 1, 1, 2});
  CHECK(distance(middle, cv::Mat1f(3, 3, grid.ptr<float>(0, 1))) == 0.0);
}

TEST_CASE("padding can be wider than the image") {
  const std::array<int, 4> shape{1, 1, 1, 2};
  cv::Mat grid(4, shape.data(), CV_32F);
  grid.ptr<float>()[0] = 1.0F;
  grid.ptr<float>()[1] = 2.0F;
  cv::Mat padded;
  pad_reflected(grid, Padding::to_multiple({2, 1}, 8), padded);
  REQUIRE(padded.size[2] == 8);
  REQUIRE(padded.size[3] == 8);
  for (int i = 0; i < 64; ++i) CHECK(padded.ptr<float>()[i] == (i % 2 == 0 ? 2.0F : 1.0F));
}

TEST_CASE("the unsharp mask is 1.3 I - 0.3 G I, with the published kernel and zeros around") {
  // The shares of the normal distribution in the fifths of [-1.3, 1.3], from a table: their roots, of sum 1.
  const std::array<double, 3> shares{0.1208950, 0.1797364, 0.2051362};  // outer, next, middle
  const double sum = 2 * std::sqrt(shares[0]) + 2 * std::sqrt(shares[1]) + std::sqrt(shares[2]);
  const std::array<double, 5> g{std::sqrt(shares[0]) / sum, std::sqrt(shares[1]) / sum,
                                std::sqrt(shares[2]) / sum, std::sqrt(shares[1]) / sum,
                                std::sqrt(shares[0]) / sum};
  cv::Mat1f point(9, 9, 0.0F);
  point(4, 4) = 1.0F;
  const cv::Mat1f sharp = unsharp(point, 0.3);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool near = std::abs(y - 4) <= 2 && std::abs(x - 4) <= 2;
      const double blurred =
          near ? g.at(static_cast<std::size_t>(y - 2)) * g.at(static_cast<std::size_t>(x - 2)) : 0.0;
      const double expected = (y == 4 && x == 4 ? 1.3 : 0.0) - 0.3 * blurred;
      CHECK(std::abs(static_cast<double>(sharp(y, x)) - expected) < 2e-5);
    }
  }
  const cv::Mat1f even = unsharp(cv::Mat1f(9, 9, 0.5F), 0.3);
  CHECK(even(4, 4) == Approx(0.5));
  const double inside = g[2] + g[3] + g[4];  // of the kernel at a corner, along each side
  CHECK(even(0, 0) == Approx(0.65 - 0.15 * inside * inside).margin(2e-5));
}

TEST_CASE("levels between two values run from 0 to 255 and beyond") {
  const cv::Mat1f image = row({-1.0F, 0.0F, 0.5F, 3.0F});
  cv::Mat1f levels;
  levels_between(image, 0.0F, 1.0F, levels);
  CHECK(distance(levels, row({-255.0F, 0.0F, 127.5F, 765.0F})) < 1e-4);
  levels_between(image, -1.0F, 3.0F, levels);
  CHECK(distance(levels, row({0.0F, 63.75F, 95.625F, 255.0F})) < 1e-4);
  levels_between(image, 2.0F, 2.0F, levels);
  CHECK(distance(levels, cv::Mat1f(1, 4, kMidGrey)) == 0.0);
}

TEST_CASE("a percentile lies between the sorted values") {
  const cv::Mat1f image = (cv::Mat1f(2, 3) << 50, 10, 30, 20, 60, 40);
  CHECK(percentile(image, 0.0) == 10.0F);
  CHECK(percentile(image, 100.0) == 60.0F);
  CHECK(percentile(image, 50.0) == 35.0F);
  CHECK(percentile(image, 1.0) == Approx(10.5));
  CHECK(percentile(image, 99.0) == Approx(59.5));
  CHECK(percentile(cv::Mat1f(1, 1, 7.0F), 99.0) == 7.0F);
}
