#include "esi/recon/flow/grey_levels.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

namespace {

using namespace esi;
using Catch::Detail::Approx;

cv::Mat1f random_plane(cv::Size size) {
  cv::Mat1f image(size);
  cv::RNG random(7);
  random.fill(image, cv::RNG::NORMAL, 3.0, 2.0);
  return image;
}

TEST_CASE("Grey levels have their mean at mid-grey, and white so many deviations above it") {
  for (const cv::Size size : {cv::Size(1, 2), cv::Size(17, 5), cv::Size(32, 3), cv::Size(101, 40)}) {
    for (const double deviations : {0.5, 1.5, 4.0}) {
      CAPTURE(size, deviations);
      cv::Mat1f levels;
      grey_levels(random_plane(size), deviations, levels);
      cv::Scalar mean, deviation;
      cv::meanStdDev(levels, mean, deviation);
      CHECK(levels.size() == size);
      CHECK(mean[0] == Approx(127.5).margin(1e-3));
      CHECK(deviation[0] == Approx(127.5 / deviations).epsilon(1e-4));
    }
  }
}

TEST_CASE("An image without anything in it is mid-grey, and what is brighter has a higher level") {
  cv::Mat1f levels;
  grey_levels(cv::Mat1f(9, 20, 5.3F), 1.5, levels);
  CHECK(cv::countNonZero(levels != 127.5F) == 0);
  const cv::Mat1f slope = (cv::Mat1f(1, 3) << -1.0F, 0.0F, 1.0F);
  grey_levels(slope, 1.5, levels);
  CHECK(levels(0) < levels(1));
  CHECK(levels(1) == Approx(127.5));
  CHECK(levels(2) > levels(1));
}

}  // namespace
