#include "esi/recon/flow/event_image.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>

using namespace esi;

namespace {

constexpr SensorSize kSize{4, 3};

std::vector<Event> events(std::size_t on, std::size_t off) {
  std::vector<Event> all(on, {0, 1, 2, true});
  all.insert(all.end(), off, {0, 3, 0, false});
  return all;
}

}  // namespace

TEST_CASE("without balance an event image counts, and starts anew in each window") {
  EventImage image(kSize, false);
  image.of(events(5, 7), {});
  const cv::Mat1f& b = image.of(events(3, 2), {});
  CHECK(b(2, 1) == 3.0F);
  CHECK(b(0, 3) == -2.0F);
  CHECK(cv::countNonZero(b) == 2);
  const std::vector<float> weights{0.5F, 2.0F};
  CHECK(image.of(events(2, 0), weights)(2, 1) == 2.5F);
}

TEST_CASE("with balance the windows before decide what ON and OFF count") {
  EventImage image(kSize, true);
  CHECK(image.of(events(40000, 90000), {})(2, 1) == 40000.0F);  // nothing is known yet
  const cv::Mat1f& b = image.of(events(1, 1), {});
  CHECK(b(2, 1) == Approx(std::sqrt(91.0 / 41.0)));
  CHECK(b(0, 3) == Approx(-std::sqrt(41.0 / 91.0)));
}

TEST_CASE("the balance is bounded, and follows a ratio that changes") {
  EventImage image(kSize, true);
  image.of(events(0, 1000000), {});
  CHECK(image.of(events(1, 0), {})(2, 1) == Approx(4.0));
  for (int i = 0; i < 20; ++i) image.of(events(1000000, 1000000), {});
  CHECK(image.of(events(1, 0), {})(2, 1) == Approx(1.0).epsilon(0.02));
}
