#include "esi/recon/steps/tone.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "esi/core/error.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

cv::Mat1f random_levels(int rows, int cols) {
  std::mt19937 random(7);
  cv::Mat1f levels(rows, cols);
  for (float& level : levels) level = static_cast<float>(random() % 40000) / 100.0F - 70.0F;
  return levels;
}

cv::Mat1f smoothed(const SmoothingOptions& options, const cv::Mat1f& levels) {
  cv::Mat1f result = levels.clone();
  Smoothing(options).apply(result);
  return result;
}

/// The border goes on: the median's.
float clamped_at(const cv::Mat1f& levels, int y, int x) {
  return levels(std::clamp(y, 0, levels.rows - 1), std::clamp(x, 0, levels.cols - 1));
}

/// gfedcb|abcdefgh|gfedcba: the Gaussian's border.
float mirrored_at(const cv::Mat1f& levels, int y, int x) {
  const auto mirror = [](int i, int n) { return i < 0 ? -i : i >= n ? 2 * n - 2 - i : i; };
  return levels(mirror(y, levels.rows), mirror(x, levels.cols));
}

}  // namespace

TEST_CASE("the median is the fifth of nine levels, without rounding or clamping") {
  const cv::Mat1f levels = random_levels(13, 17);
  const cv::Mat1f medians = smoothed({.median = true, .blur_px = 0.0}, levels);
  for (int y = 0; y < levels.rows; ++y) {
    for (int x = 0; x < levels.cols; ++x) {
      std::vector<float> nine;
      for (int i = 0; i < 9; ++i) nine.push_back(clamped_at(levels, y + i / 3 - 1, x + i % 3 - 1));
      std::sort(nine.begin(), nine.end());
      REQUIRE(medians(y, x) == nine[4]);
    }
  }
}

TEST_CASE("the Gaussian is the sum that its formula says") {
  const double sigma_px = GENERATE(0.5, 0.7, 1.6);
  const cv::Mat1f levels = random_levels(20, 24);
  const cv::Mat1f blurred = smoothed({.median = false, .blur_px = sigma_px}, levels);
  const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
  for (int y = 0; y < levels.rows; ++y) {
    for (int x = 0; x < levels.cols; ++x) {
      double sum = 0.0;
      double weights = 0.0;
      for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
          const double w = std::exp(-(u * u + v * v) / (2.0 * sigma_px * sigma_px));
          sum += w * static_cast<double>(mirrored_at(levels, y + v, x + u));
          weights += w;
        }
      }
      REQUIRE(static_cast<double>(blurred(y, x)) == Approx(sum / weights).margin(0.01));
    }
  }
}

TEST_CASE("the median comes before the Gaussian, and neither changes what is off") {
  const cv::Mat1f levels = random_levels(9, 9);
  CHECK(cv::norm(smoothed({}, levels), levels, cv::NORM_INF) == 0);
  const SmoothingOptions median{.median = true, .blur_px = 0.0};
  const SmoothingOptions blur{.median = false, .blur_px = 1.0};
  const SmoothingOptions both{.median = true, .blur_px = 1.0};
  CHECK(cv::norm(smoothed(both, levels), smoothed(blur, smoothed(median, levels)), cv::NORM_INF) == 0);
}

TEST_CASE("images smaller than a kernel are smoothed too") {
  const cv::Mat1f pixel(1, 1, 42.0F);
  CHECK(smoothed({.median = true, .blur_px = 20.0}, pixel)(0, 0) == Approx(42.0F));
}

TEST_CASE("percentiles become black and white") {
  cv::Mat1f levels(1, 101);
  for (int x = 0; x <= 100; ++x) levels(0, (x * 37) % 101) = static_cast<float>(2 * x - 50);
  RangeStretch stretch({.range = Range::percentile, .low_percent = 9.6, .high_percent = 60.4});
  const cv::Mat1f before = levels.clone();
  stretch.apply(levels);
  for (int x = 0; x <= 100; ++x) {
    CHECK(levels(0, x) == Approx((before(0, x) + 30.0F) * 255.0F / 100.0F).margin(1e-3));
  }
}

TEST_CASE("an image without contrast and a fixed range stay as they are") {
  cv::Mat1f levels(4, 4, 127.5F);
  levels(1, 1) = 128.4F;
  const cv::Mat1f before = levels.clone();
  RangeStretch({.range = Range::percentile, .low_percent = 0.0, .high_percent = 100.0}).apply(levels);
  CHECK(cv::norm(levels, before, cv::NORM_INF) == 0);
  cv::Mat1f random = random_levels(5, 5);
  const cv::Mat1f same = random.clone();
  RangeStretch({}).apply(random);
  CHECK(cv::norm(random, same, cv::NORM_INF) == 0);
}

TEST_CASE("percentiles in the wrong order are refused") {
  CHECK_THROWS_WITH(RangeStretch({.range = Range::fixed, .low_percent = 99.0, .high_percent = 99.0}),
                    Contains("low_percent") && Contains("high_percent"));
}
