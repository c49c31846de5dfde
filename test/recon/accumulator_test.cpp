#include "esi/recon/accumulator.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "accumulator_reference.hpp"
#include "esi/core/error.hpp"
#include "level_errors.hpp"
#include "support/random_events.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kThree{3, 3};

Event at(std::int64_t t_us, bool on) { return {t_us, 1, 1, on}; }

/// V within -1..1 around 0, an event moves it by a quarter: 255 / 8 grey levels.
AccumulatorOptions centred(AccumulatorDecay decay) {
  AccumulatorOptions options;
  options.decay = decay;
  options.contribution = 0.25;
  options.v_min = -1.0;
  return options;
}

double potential(const AccumulatorOptions& options, const std::vector<Event>& events, std::int64_t t_us) {
  Accumulator accumulator(options, kThree);
  accumulator.process(events);
  cv::Mat1f levels;
  accumulator.render_levels(t_us, levels);
  CHECK(levels(0, 0) == levels(2, 2));
  return options.v_min + static_cast<double>(levels(1, 1)) / 255.0 * (options.v_max - options.v_min);
}

}  // namespace

TEST_CASE("the accumulator's defaults are dv-processing's") {
  const AccumulatorOptions options;
  CHECK(potential(options, {}, 0) == 0.0);
  CHECK(potential(options, {at(0, true)}, 5000000) == Approx(0.15));
  CHECK(potential(options, {at(0, false), at(0, true)}, 0) == Approx(0.15));  // an OFF event is lost at 0
  CHECK(potential(options, {at(0, true), at(1000000, true)}, 0) == Approx(0.15 * std::exp(-1.0) + 0.15));
  CHECK(potential(options, std::vector<Event>(9, at(0, true)), 0) == Approx(1.0));
}

TEST_CASE("each decay of the accumulator does what its name says") {
  struct Row {
    AccumulatorDecay decay;
    std::vector<Event> events;
    double v;
  };
  const std::vector<Event> up{at(0, true), at(0, true)};
  const std::vector<Event> down{at(0, false), at(0, false)};
  using enum AccumulatorDecay;
  const auto row =
      GENERATE_COPY(Row{exponential, {up[0], up[1], at(500000, true)}, 0.5 * std::exp(-0.5) + 0.25},
                    Row{exponential, {down[0], down[1], at(500000, true)}, -0.5 * std::exp(-0.5) + 0.25},
                    Row{linear, {up[0], up[1], at(100000, true)}, 0.5 - 0.1 + 0.25},
                    Row{linear, {down[0], down[1], at(100000, true)}, -0.5 + 0.1 + 0.25},
                    Row{linear, {up[0], up[1], at(900000, true)}, 0.25},      // no further than neutral
                    Row{linear, {down[0], down[1], at(900000, true)}, 0.25},  //
                    Row{step, {up[0], up[1], at(1000000, true)}, 0.75},       // not more than the step time
                    Row{step, {up[0], up[1], at(1000001, true)}, 0.25},       //
                    Row{step, {up[0], at(900000, true), at(1800000, true)}, 0.75},  // since the last event
                    Row{none, {up[0], up[1], at(1LL << 50, true)}, 0.75});
  const AccumulatorOptions options = centred(row.decay);
  CHECK(potential(options, row.events, row.events.back().t_us) == Approx(row.v).epsilon(1e-4));
}

TEST_CASE("the accumulator decays to a frame's time only when told so, and keeps its state") {
  const auto [decay, v] =
      GENERATE(table<AccumulatorDecay, double>({{AccumulatorDecay::exponential, 0.5 * std::exp(-1.5)},
                                                {AccumulatorDecay::linear, 0.0},
                                                {AccumulatorDecay::step, 0.0},
                                                {AccumulatorDecay::none, 0.5}}));
  AccumulatorOptions options = centred(decay);
  const std::vector<Event> events{at(0, true), at(0, true)};
  CHECK(potential(options, events, 1500000) == Approx(0.5));
  options.readout_decay = true;
  CHECK(potential(options, events, 1500000) == Approx(v).margin(1e-5));
  CHECK(potential(options, events, -5) == Approx(0.5));  // a time before the last event counts as that
  CHECK(potential(options, {}, 1LL << 60) == 0.0);

  Accumulator often(options, kThree), once(options, kThree);
  cv::Mat1f levels, expected;
  often.process(events);
  once.process(events);
  for (std::int64_t t_us = 0; t_us < 4000000; t_us += 50000) often.render_levels(t_us, levels);
  often.render_levels(600000, levels);
  once.render_levels(600000, expected);
  CHECK(cv::norm(levels, expected, cv::NORM_INF) == 0);
}

TEST_CASE("a neutral potential inside the range is shown between black and white") {
  AccumulatorOptions options;
  options.v_min = -1.0;
  options.v_max = 3.0;
  options.v_neutral = 1.0;
  options.contribution = 0.5;
  CHECK(potential(options, {}, 0) == Approx(1.0));
  CHECK(potential(options, {at(0, false)}, 0) == Approx(0.5));
  CHECK(potential(options, std::vector<Event>(9, at(0, false)), 0) == Approx(-1.0));
  CHECK(potential(options, std::vector<Event>(9, at(0, true)), 0) == Approx(3.0));
}

TEST_CASE("random events agree with the accumulator's reference") {
  const SensorSize size{8, 6};
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    AccumulatorOptions options;
    options.decay = static_cast<AccumulatorDecay>(seed % 4);
    options.tau_s = uniform(0.01, 3.0);
    options.slope_hz = uniform(0.1, 10.0);
    options.step_s = uniform(0.01, 0.5);
    options.contribution = uniform(0.02, 0.5);
    options.v_neutral = uniform(-0.5, 0.5);
    options.v_min = options.v_neutral - uniform(0.0, 1.0);
    options.v_max = options.v_neutral + uniform(0.1, 1.0);
    options.readout_decay = random() % 2 == 0;
    for (const int gap_us : {1, 100, 5000, 400000}) {
      const auto events = test::random_events({0, 0, 8, 6}, 3000, gap_us, seed);
      std::vector<float> weights(random() % 2 == 0 ? 0 : events.size());
      for (float& weight : weights) weight = static_cast<float>(uniform(0.0, 2.0));
      Accumulator accumulator(options, size);
      test::AccumulatorReference reference(options, size);
      accumulator.process(events, weights);
      reference.process(events, weights);
      for (const std::int64_t later_us : {1LL, 30000LL, 3000000000LL}) {
        const std::int64_t t_us = events.back().t_us + later_us;
        REQUIRE(test::largest_level_error(accumulator, reference, t_us) < 0.01);
      }
    }
  }
}

TEST_CASE("bounds that don't hold the neutral potential are a usage error") {
  const auto [v_min, v_neutral, v_max] = GENERATE(
      table<double, double, double>({{0.0, -0.1, 1.0}, {0.0, 1.1, 1.0}, {0.5, 0.5, 0.5}, {1.0, 0.5, 0.0}}));
  AccumulatorOptions options;
  options.v_min = v_min;
  options.v_neutral = v_neutral;
  options.v_max = v_max;
  CHECK_THROWS_WITH(Accumulator(options, kThree), Contains("v_min") && Contains("v_max"));
}
