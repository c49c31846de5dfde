#include "esi/recon/complementary.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "complementary_reference.hpp"
#include "esi/core/error.hpp"
#include "level_errors.hpp"
#include "support/random_events.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kThree{3, 3};
constexpr double kAlpha = std::numbers::pi;  ///< of the default cutoff, 1/s

Event at(std::int64_t t_us, bool on) { return {t_us, 1, 1, on}; }

IntensityFrame flat_frame(std::int64_t end_us, int grey) {
  return {{end_us - 1000, end_us}, cv::Mat1b(3, 3, static_cast<std::uint8_t>(grey))};
}

/// L in the middle, read back from the default display.
double log_intensity(Reconstructor& filter, std::int64_t t_us) {
  cv::Mat1f levels;
  filter.render_levels(t_us, levels);
  return std::log(static_cast<double>(levels(1, 1)) / 255.0 * 1.3 - 0.1 + 1.0);
}

}  // namespace

TEST_CASE("the high-pass filter forgets at its cutoff frequency, also up to the frame's time") {
  const double neutral = std::log(1.5);
  HighPass filter({}, kThree);
  CHECK(log_intensity(filter, 0) == Approx(neutral));
  CHECK(log_intensity(filter, std::int64_t{1} << 60) == Approx(neutral));
  filter.process(std::vector<Event>{at(0, true), at(200000, true), at(200000, false), at(200000, false)});
  const double l = 0.1 * std::exp(-0.2 * kAlpha) - 0.1;
  CHECK(log_intensity(filter, 200000) == Approx(neutral + l).epsilon(1e-5));
  CHECK(log_intensity(filter, 700000) == Approx(neutral + l * std::exp(-0.5 * kAlpha)).epsilon(1e-5));
  CHECK(log_intensity(filter, std::int64_t{1} << 40) == Approx(neutral));
}

TEST_CASE("the high-pass filter doesn't look at intensity frames") {
  HighPass filter({}, kThree);
  filter.observe(flat_frame(0, 0));
  filter.observe({{0, 0}, cv::Mat1b(1, 1)});
  CHECK(log_intensity(filter, 10000000) == Approx(std::log(1.5)));
}

TEST_CASE("ON and OFF thresholds are the filter's own") {
  HighPassOptions options;
  options.c_on = 0.3;
  options.c_off = 0.2;
  HighPass filter(options, kThree);
  filter.process(std::vector<Event>{at(0, true), at(0, false)});
  CHECK(log_intensity(filter, 0) == Approx(std::log(1.5) + 0.1));
}

TEST_CASE("the complementary filter goes to the last intensity frame, of 8 or 16 bits") {
  Complementary filter({}, kThree);
  CHECK(log_intensity(filter, 5) == Approx(std::log(1.5)));
  filter.process(std::vector<Event>{at(0, true)});
  filter.observe(flat_frame(100000, 51));  // until now the reference was the constant
  const double before = std::log(1.5) + 0.1 * std::exp(-0.1 * kAlpha);
  CHECK(log_intensity(filter, 100000) == Approx(before).epsilon(1e-5));
  const double dark = std::log(1.2);
  const double beta = std::exp(-0.2 * kAlpha);
  CHECK(log_intensity(filter, 300000) == Approx(beta * before + (1 - beta) * dark).epsilon(1e-5));
  filter.process(std::vector<Event>{at(300000, false)});
  const double after = beta * before + (1 - beta) * dark - 0.1;
  CHECK(log_intensity(filter, 500000) == Approx(beta * after + (1 - beta) * dark).epsilon(1e-5));
  CHECK(log_intensity(filter, 100000000) == Approx(dark).epsilon(1e-5));

  filter.observe({{0, 200000000}, cv::Mat1w(3, 3, static_cast<std::uint16_t>(26214))});  // 0.4
  CHECK(log_intensity(filter, 200000000) == Approx(dark).epsilon(1e-5));
  CHECK(log_intensity(filter, 300000000) == Approx(std::log(1.4)).epsilon(1e-5));
}

TEST_CASE("a display range maps exp(L) - 1 to black and white") {
  ComplementaryOptions options;
  options.show_min = 0.2;
  options.show_max = 0.6;
  options.cutoff_hz = 1000.0;
  cv::Mat1f levels;
  for (const auto& [grey, level] : {std::pair(51, 0.0), {102, 127.5}, {153, 255.0}, {0, -127.5}}) {
    Complementary filter(options, kThree);
    filter.observe(flat_frame(0, grey));
    filter.render_levels(1000000, levels);
    CHECK(levels(1, 1) == Approx(level).margin(0.01));
  }
}

TEST_CASE("intensity frames that don't fit are refused in words") {
  Complementary filter({}, kThree);
  CHECK_THROWS_WITH(filter.observe({{0, 1500000}, cv::Mat1b(3, 4)}),
                    Contains("1.5") && Contains("4x3 px") && Contains("3x3"));
  CHECK_THROWS_WITH(filter.observe({{0, 0}, cv::Mat1f(3, 3)}), Contains("8 or 16 bits"));
}

TEST_CASE("a display without range is a usage error") {
  HighPassOptions options;
  options.show_max = -0.1;
  CHECK_THROWS_WITH(HighPass(options, kThree), Contains("show_min") && Contains("show_max"));
}

TEST_CASE("random events and frames agree with the filter's reference") {
  const SensorSize size{8, 6};
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    ComplementaryOptions options;
    options.cutoff_hz = seed % 6 == 0 ? 0.0 : uniform(0.01, 5.0);
    options.c_on = uniform(0.01, 0.1);
    options.c_off = uniform(0.01, 0.1);
    options.spare_saturated = seed % 2 == 0;
    const bool with_frames = seed % 4 != 3;
    for (const int gap_us : {1, 100, 5000, 400000}) {
      auto events = test::random_events({0, 0, 8, 6}, 2000, gap_us, seed);
      for (Event& event : events) event.t_us -= 7000;
      Complementary filter(options, size);
      test::ComplementaryReference reference(options, size);
      for (std::size_t begin = 0; begin < events.size(); begin += 500) {
        std::vector<float> weights(begin == 500 ? 500 : 0);
        for (float& weight : weights) weight = static_cast<float>(uniform(0.0, 2.0));
        const auto part = std::span(events).subspan(begin, 500);
        filter.process(part, weights);
        reference.process(part, weights);
        if (!with_frames) continue;
        cv::Mat1b image(6, 8);
        for (std::uint8_t& pixel : image) pixel = static_cast<std::uint8_t>(random() % 256);
        image(0, 0) = 0;
        image(0, 1) = 255;
        filter.observe({{0, part.back().t_us}, image});
        reference.observe(part.back().t_us, [&](int x, int y) { return image(y, x) / 255.0; });
      }
      for (const std::int64_t later_us : {1LL, 30000LL, 3000000000LL}) {
        const std::int64_t t_us = events.back().t_us + later_us;
        REQUIRE(test::largest_level_error(filter, reference, t_us) < 0.05);
      }
    }
  }
}
