#include "esi/recon/esi.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi_reference.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kThree{3, 3};

/// gamma = 1 - dt / 1 s, c = 1, E within -2..2: grey 128 is E = 0, and 1 is 63.75 grey levels.
EsiOptions linear() {
  EsiOptions options;
  options.decay = {.decay = Decay::polynomial, .tau_s = 1.0, .n = 1.0, .alpha_hz = 0.0};
  options.e_min = -2.0;
  options.e_max = 2.0;
  return options;
}

Event at(std::int64_t t_us, bool on) { return {t_us, 1, 1, on}; }

int grey_in_the_middle(const EsiOptions& options, const std::vector<Event>& events, std::int64_t t_us) {
  Esi esi(options, kThree);
  esi.process(events);
  cv::Mat1b grey;
  esi.render(t_us, grey);
  return grey(1, 1);
}

}  // namespace

TEST_CASE("a pixel decays, adds and clamps as the equations say") {
  struct Row {
    std::vector<Event> events;
    int grey;
  };
  const auto row = GENERATE(
      Row{{}, 128},                                                      // 0
      Row{{at(0, true)}, 191},                                           // 1
      Row{{at(0, false)}, 64},                                           // -1
      Row{{at(0, true), at(500000, true)}, 223},                         // 0.5 + 1
      Row{{at(0, true), at(500000, false)}, 96},                         // 0.5 - 1
      Row{{at(0, true), at(500000, true), at(750000, false)}, 135},      // 0.75 * 1.5 - 1 = 0.125
      Row{{at(0, true), at(0, true)}, 255},                              // 2
      Row{{at(0, true), at(0, true), at(0, true)}, 255},                 // clamped
      Row{{at(0, true), at(0, true), at(0, true), at(0, false)}, 191},   // clamped at each event: 2 - 1
      Row{{at(0, false), at(0, false), at(0, false), at(0, true)}, 64},  // -2 + 1
      Row{{at(0, true), at(1000000, true)}, 191},                        // forgotten after tau
      Row{{at(0, true), at(999999, true)}, 191},                         // 1e-6 + 1
      Row{{at(0, true), at(90000000, false)}, 64},                       // forgotten long ago
      Row{{at(-5000000, true), at(-4500000, true)}, 223});               // any clock
  CHECK(grey_in_the_middle(linear(), row.events, 100000000) == row.grey);
}

TEST_CASE("every form of the decay is applied between events") {
  EsiOptions options = linear();
  const std::vector<Event> events{at(0, true), at(500000, true)};
  const auto [form, n, alpha_hz, grey] =
      GENERATE(table<Decay, double, double, int>({{Decay::polynomial, 2.0, 0.0, 207},   // 0.25 + 1
                                                  {Decay::polynomial, 1.5, 0.0, 214},   // 0.354 + 1
                                                  {Decay::power, 2.0, 0.0, 239},        // 0.75 + 1
                                                  {Decay::power, 2.0, 1.0, 220},        // 0.455 + 1
                                                  {Decay::exponential, 9.0, 1.0, 230},  // 0.607 + 1
                                                  {Decay::none, 9.0, 1.0, 255}}));
  options.decay = {.decay = form, .tau_s = 1.0, .n = n, .alpha_hz = alpha_hz};
  CHECK(grey_in_the_middle(options, events, 600000) == grey);
}

TEST_CASE("ON and OFF events have their own increments, and bounds need not be symmetric") {
  EsiOptions options = linear();
  options.c_on = 0.25;
  options.c_off = 0.75;
  options.e_min = -1.0;
  options.e_max = 3.0;
  CHECK(grey_in_the_middle(options, {}, 10) == 64);                           // E = 0 is a quarter up
  CHECK(grey_in_the_middle(options, {at(0, true)}, 10) == 80);                // 1.25 / 4
  CHECK(grey_in_the_middle(options, {at(0, false)}, 10) == 16);               // 0.25 / 4
  CHECK(grey_in_the_middle(options, {at(0, false), at(0, false)}, 10) == 0);  // clamped at -1
}

TEST_CASE("bounds may begin at 0") {
  EsiOptions options = linear();
  options.e_min = 0.0;
  CHECK(grey_in_the_middle(options, {}, 10) == 0);
  CHECK(grey_in_the_middle(options, {at(0, false), at(0, true)}, 10) == 128);
}

TEST_CASE("x counts from the left and y from the top, and pixels don't touch each other") {
  Esi esi(linear(), {3, 2});
  esi.process(std::vector<Event>{{0, 2, 0, true}, {0, 0, 1, false}});
  cv::Mat1b grey;
  esi.render(10, grey);
  const cv::Mat1b expected = (cv::Mat1b(2, 3) << 128, 128, 191, 64, 128, 128);
  CHECK(cv::countNonZero(grey != expected) == 0);
}

TEST_CASE("without readout decay a frame's time doesn't matter; with it E fades to that time") {
  EsiOptions options = linear();
  CHECK(grey_in_the_middle(options, {at(0, true)}, 500000) == 191);
  options.readout_decay = true;
  CHECK(grey_in_the_middle(options, {at(0, true)}, 0) == 191);
  CHECK(grey_in_the_middle(options, {at(0, true)}, 500000) == 159);  // 0.5
  CHECK(grey_in_the_middle(options, {at(0, true)}, 1000000) == 128);
  CHECK(grey_in_the_middle(options, {at(0, true)}, std::int64_t{1} << 40) == 128);
  CHECK(grey_in_the_middle(options, {}, 1000000) == 128);
}

TEST_CASE("rendering leaves the state alone") {
  EsiOptions options = linear();
  options.readout_decay = GENERATE(false, true);
  Esi often(options, kThree);
  Esi once(options, kThree);
  cv::Mat1b grey;
  cv::Mat1b expected;
  for (std::int64_t t_us = 0; t_us < 3000000; t_us += 300000) {
    const std::vector<Event> events{at(t_us, true), {t_us, 0, 0, false}};
    once.process(events);
    often.process(events);
    for (std::int64_t k = 1; k <= 20; ++k) often.render(t_us + k * 10000, grey);
  }
  often.render(std::int64_t{1} << 35, grey);
  often.render(2800000, grey);
  once.render(2800000, expected);
  CHECK(cv::countNonZero(grey != expected) == 0);
}

TEST_CASE("bounds of E that leave no range around 0 are a usage error") {
  const auto [e_min, e_max] = GENERATE(table<double, double>(
      {{1.0, 2.0}, {-2.0, -1.0}, {0.0, 0.0}, {2.0, -2.0}, {0.0, 1e-300}, {-1e-9, 1e-9}}));
  EsiOptions options;
  options.e_min = e_min;
  options.e_max = e_max;
  try {
    Esi(options, kThree);
    FAIL("taken: " << e_min << " " << e_max);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::usage);
    CHECK_THAT(error.what(), Contains("e_min") && Contains("e_max"));
  }
}
