#include "esi/sim/pixel_array.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "esi/core/error.hpp"
#include "sim/sensor_fixture.hpp"

using namespace esi;
using test::camera_of;
using test::ideal_sensor;
using test::record;

namespace {

constexpr const char* kSmall = "20x16";
constexpr std::size_t kSmallPixels = 20 * 16;

std::vector<SensorEvent> of_pixel(const std::vector<SensorEvent>& events, int x, int y) {
  std::vector<SensorEvent> own;
  for (const SensorEvent& event : events) {
    if (event.x == x && event.y == y) own.push_back(event);
  }
  return own;
}

}  // namespace

TEST_CASE("A still scene without noise gives no events, however its pixels begin and differ") {
  SensorOptions options = ideal_sensor();
  options.random_start = GENERATE(false, true);
  options.lowpass = GENERATE(false, true);
  options.mismatch = 0.05;
  options.refractory_ms = 0.5;
  options.dark_current_lux = 0.3;
  CHECK(record(
            options, kSmall, [](double) { return 0.3; }, 3'000'000, 1000)
            .empty());
}

TEST_CASE("A ramp of k thresholds gives k events per pixel, at the times when it crosses them") {
  const std::int32_t step_us = GENERATE(1000, 250);
  const double sign = GENERATE(1.0, -1.0);
  SensorOptions options = ideal_sensor();
  options.threshold = 0.2;
  options.threshold_ratio = 1.44;  // C_on 0.24, C_off 0.1667
  const double c = sign > 0 ? 0.24 : 0.2 / 1.2;
  constexpr int kThresholds = 7;
  constexpr double kDuration_s = 0.5;
  const double slope = sign * (kThresholds + 0.5) * c / kDuration_s;
  const auto events = record(
      options, kSmall, [=](double t_s) { return 0.1 * std::exp(slope * t_s); }, 500'000, step_us);
  REQUIRE(events.size() == kSmallPixels * kThresholds);
  for (const auto& [x, y] : {std::pair{0, 0}, {19, 15}, {7, 11}}) {
    const auto own = of_pixel(events, x, y);
    REQUIRE(own.size() == kThresholds);
    for (int k = 0; k < kThresholds; ++k) {
      const SensorEvent& event = own[static_cast<std::size_t>(k)];
      CHECK(event.on == (sign > 0));
      CHECK(event.cause == EventCause::signal);
      CHECK(event.t_us == Approx((k + 1) * c / std::abs(slope) * 1e6).margin(3.0));
    }
  }
}

TEST_CASE("Dark current compresses contrast") {
  SensorOptions options = ideal_sensor();
  options.illuminance_lux = 2.0;
  options.dark_current_lux = 0.2;  // 0.1 of white
  const test::Light light = [](double t_s) { return 0.1 + 0.8 * t_s; };
  const auto count = [&] { return record(options, kSmall, light, 1'000'000, 1000).size() / kSmallPixels; };
  CHECK(count() == static_cast<std::size_t>(std::log(1.0 / 0.2) / 0.25));
  options.dark_current_lux = 0.0;
  CHECK(count() == static_cast<std::size_t>(std::log(0.9 / 0.1) / 0.25));
}

TEST_CASE("The low-pass delays a ramp by its time constant") {
  const std::int32_t step_us = GENERATE(1000, 200);
  const double cutoff_hz = GENERATE(5.0, 30.0, 300.0);
  SensorOptions options = ideal_sensor();
  const test::Light ramp = [](double t_s) { return 0.1 * std::exp(2.1 * t_s); };
  const auto prompt = of_pixel(record(options, kSmall, ramp, 1'000'000, step_us), 3, 4);
  options.lowpass = true;
  options.cutoff_white_hz = options.cutoff_dark_hz = cutoff_hz;
  const auto late = of_pixel(record(options, kSmall, ramp, 1'000'000, step_us), 3, 4);
  const double tau_us = 1e6 / (2.0 * std::numbers::pi * cutoff_hz);
  REQUIRE(prompt.size() == 8);
  REQUIRE(late.size() >= 6);
  for (std::size_t k = 2; k < late.size(); ++k) {  // from 357 ms on the start is forgotten
    CHECK(late[k].t_us - prompt[k].t_us == Approx(tau_us).epsilon(0.003).margin(3.0));
  }
}

TEST_CASE("An edge passes as an exponential whose cutoff grows with intensity from dark to white") {
  SensorOptions options = ideal_sensor();
  options.threshold = 0.01;
  options.lowpass = true;
  options.cutoff_white_hz = 100.0;
  options.cutoff_dark_hz = 10.0;
  const double light = GENERATE(0.05, 0.4, 0.9);
  constexpr double kEdge = 0.095;  // ln: 9.5 thresholds
  constexpr std::int32_t kStep_us = 100;
  const auto events =
      of_pixel(record(
                   options, kSmall, [=](double t_s) { return t_s > 0.0 ? light * std::exp(kEdge) : light; },
                   200'000, kStep_us),
               0, 0);
  REQUIRE(events.size() == 9);
  const double after = light * std::exp(kEdge);
  const double tau_us = 1e6 / (2.0 * std::numbers::pi * (10.0 + 90.0 * after));
  for (int k = 1; k <= 6; ++k) {
    // The edge itself is a slope of one step: on average it comes half a step late.
    const double expected_us = 0.5 * kStep_us - tau_us * std::log(1.0 - 0.01 * k / kEdge);
    CHECK(events[static_cast<std::size_t>(k - 1)].t_us == Approx(expected_us).epsilon(0.01).margin(5.0));
  }
}

TEST_CASE("In the refractory period a pixel keeps its memory: events come late, but all of them") {
  SensorOptions options = ideal_sensor();
  options.refractory_ms = 3.0;
  constexpr double kRise = 6.5 * 0.25;  // within 1 ms, far faster than one event per 3 ms
  const auto events = of_pixel(
      record(
          options, kSmall, [](double t_s) { return 0.1 * std::exp(kRise * std::min(1.0, t_s * 1e3)); },
          100'000, 1000),
      5, 5);
  REQUIRE(events.size() == 6);
  CHECK(events.front().t_us == Approx(1000.0 / 6.5).margin(2));
  for (std::size_t k = 1; k < events.size(); ++k) CHECK(events[k].t_us == events[k - 1].t_us + 3000);
}

TEST_CASE("What has passed within the refractory period leaves no event") {
  SensorOptions options = ideal_sensor();
  options.refractory_ms = 10.0;
  const auto bump = [](double t_s) {  // up by 2.4 thresholds for 5 ms
    return t_s > 0.0005 && t_s < 0.0055 ? 0.1 * std::exp(0.6) : 0.1;
  };
  const auto events = of_pixel(record(options, kSmall, bump, 50'000, 1000), 5, 5);
  REQUIRE(events.size() == 2);  // up once; once the pixel looks again, it is one threshold too high
  CHECK(events[0].on);
  CHECK_FALSE(events[1].on);
}

TEST_CASE("The events of a noise-free pixel, times its thresholds, sum up to its log intensity") {
  SensorOptions options = ideal_sensor();
  options.mismatch = 0.05;
  options.threshold_ratio = 1.7;
  const Camera camera = camera_of(kSmall);
  PixelArray pixels(options, camera, 3);
  const test::Light light = [](double t_s) {
    return 0.2 * std::exp(1.2 * std::sin(9.0 * t_s) + 0.7 * std::sin(23.0 * t_s + 1.0) +
                          0.2 * std::sin(151.0 * t_s));
  };
  const auto events = record(pixels, camera.size, light, 2'000'000, 1000);
  REQUIRE(events.size() > 50 * kSmallPixels);
  for (const auto& [x, y] : {std::pair{0, 0}, {19, 15}, {7, 11}, {12, 3}}) {
    const double on = pixels.threshold_on(x, y), off = pixels.threshold_off(x, y);
    double level = std::log(light(0.0));
    double furthest = 0.0;
    auto own = of_pixel(events, x, y);
    std::size_t i = 0;
    for (std::int32_t t_us = 1000; t_us <= 2'000'000; t_us += 1000) {
      for (; i < own.size() && own[i].t_us < t_us; ++i) level += own[i].on ? on : -off;
      furthest = std::max(furthest, std::abs(std::log(light(1e-6 * t_us)) - level));
    }
    CHECK(furthest <= std::max(on, off) * 1.001);
    CHECK(furthest > 0.5 * std::min(on, off));  // it is the thresholds that bound it
  }
}

TEST_CASE("Thresholds have the asked mean and mismatch, and no pixel knows its neighbour's") {
  SensorOptions options = ideal_sensor();
  options.threshold = 0.3;
  options.mismatch = 0.04;
  const Camera camera = camera_of("346x260");
  const PixelArray pixels(options, camera, 5);
  const auto [width, height] = camera.size;
  const double count = width * height;
  const auto on = [&](int x, int y) { return (pixels.threshold_on(x % width, y % height) - 0.3) / 0.04; };
  const auto off = [&](int x, int y) { return (pixels.threshold_off(x % width, y % height) - 0.3) / 0.04; };
  const auto mean_of = [&](auto value) {
    double sum = 0.0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) sum += value(x, y);
    }
    return sum / count;
  };
  const double four_sigma = 4.0 / std::sqrt(count);
  for (const auto& map : {std::function<double(int, int)>(on), std::function<double(int, int)>(off)}) {
    CHECK(std::abs(mean_of(map)) < four_sigma);
    CHECK(std::abs(mean_of([&](int x, int y) { return map(x, y) * map(x, y); }) - 1.0) <
          four_sigma * std::sqrt(2.0));
    for (const auto& [dx, dy] :
         {std::pair{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {16, 0}, {0, 16}, {64, 32}}) {
      INFO("lag " << dx << ", " << dy);
      CHECK(std::abs(mean_of([&](int x, int y) { return map(x, y) * map(x + dx, y + dy); })) < four_sigma);
    }
  }
  CHECK(std::abs(mean_of([&](int x, int y) { return on(x, y) * off(x, y); })) < four_sigma);
}

TEST_CASE(
    "A pixel's nature belongs to its place on the whole sensor, not to the crop or the seed of the scene") {
  SensorOptions options;
  const Camera whole = camera_of("64x48"), crop = camera_of("64x48", "32x20");
  REQUIRE(crop.origin_px == cv::Vec2i(16, 14));
  const PixelArray all(options, whole, 7), part(options, crop, 7), other(options, crop, 8);
  int same_as_other = 0;
  for (int y = 0; y < crop.size.height_px; ++y) {
    for (int x = 0; x < crop.size.width_px; ++x) {
      REQUIRE(part.threshold_on(x, y) == all.threshold_on(x + 16, y + 14));
      REQUIRE(part.threshold_off(x, y) == all.threshold_off(x + 16, y + 14));
      same_as_other += part.threshold_on(x, y) == other.threshold_on(x, y);
    }
  }
  CHECK(same_as_other < 5);
}

TEST_CASE("Sensor options that contradict one another are refused") {
  SensorOptions slow_white;
  slow_white.cutoff_dark_hz = slow_white.cutoff_white_hz + 1;
  CHECK_THROWS_WITH(slow_white.check(), Catch::Contains("cutoff_dark_hz"));
  SensorOptions hot;
  hot.hot_min_hz = hot.hot_max_hz + 1;
  CHECK_THROWS_WITH(hot.check(), Catch::Contains("hot_min_hz"));
}
