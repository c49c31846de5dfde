#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "esi/sim/pixel_array.hpp"
#include "sim/sensor_fixture.hpp"

using namespace esi;
using test::ideal_sensor;
using test::record;

namespace {

constexpr const char* kSensor = "64x48";
constexpr int kPixels = 64 * 48;

double share_on(const std::vector<SensorEvent>& events) {
  const auto on = std::count_if(events.begin(), events.end(), [](const SensorEvent& e) { return e.on; });
  return static_cast<double>(on) / static_cast<double>(events.size());
}

std::vector<std::int32_t> times_of(const std::vector<SensorEvent>& events) {
  std::vector<std::int32_t> times;
  for (const SensorEvent& event : events) times.push_back(event.t_us);
  std::sort(times.begin(), times.end());
  return times;
}

/// Events per pixel.
std::vector<double> counts_of(const std::vector<SensorEvent>& events) {
  std::vector<double> counts(kPixels, 0.0);
  for (const SensorEvent& event : events) counts[event.y * 64U + event.x] += 1.0;
  return counts;
}

}  // namespace

TEST_CASE("Shot noise has the asked rate and polarities, at black and at white, for any time step") {
  const std::int32_t step_us = GENERATE(1000, 200);
  const auto [light, factor] = GENERATE(table<double, double>({{1e-6, 1.0}, {0.5, 0.625}, {1.0, 0.25}}));
  SensorOptions options = ideal_sensor();
  options.shot_hz = 12.0;
  options.shot_on_share = 0.57;
  const auto events = record(
      options, kSensor, [light = light](double) { return light; }, 1'000'000, step_us);
  const double expected = options.shot_hz * factor * kPixels;
  const auto count = static_cast<double>(events.size());
  CHECK(std::abs(count - expected) < 4.0 * std::sqrt(expected));
  CHECK(std::abs(share_on(events) - 0.57) < 4.0 * std::sqrt(0.57 * 0.43 / count));
  for (const SensorEvent& event : events) REQUIRE(event.cause == EventCause::shot);
}

TEST_CASE("Shot noise is a Poisson process, the very same for any time step, and another for another seed") {
  SensorOptions options = ideal_sensor();
  options.shot_hz = 12.0;
  const auto grey = [](double) { return 0.4; };
  const auto events = record(options, kSensor, grey, 1'000'000, 1000);
  CHECK(times_of(record(options, kSensor, grey, 1'000'000, 125)) == times_of(events));
  CHECK(times_of(record(options, kSensor, grey, 1'000'000, 1000, 2)) != times_of(events));

  // Counts of pixels have their mean as variance; neighbours are independent.
  const std::vector<double> counts = counts_of(events);
  const double mean = static_cast<double>(events.size()) / kPixels;
  double variance = 0.0, covariance = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    variance += (counts[i] - mean) * (counts[i] - mean) / kPixels;
    covariance += (counts[i] - mean) * (counts[(i + 1) % counts.size()] - mean) / kPixels;
  }
  CHECK(variance / mean == Approx(1.0).margin(4.0 * std::sqrt(2.0 / kPixels)));
  CHECK(std::abs(covariance / mean) < 4.0 / std::sqrt(kPixels));

  // A share of 1 - exp(-1) of the waits is shorter than the mean wait.
  std::map<std::pair<int, int>, std::int32_t> last;
  double waits = 0.0, short_waits = 0.0;
  for (const SensorEvent& event : events) {
    const auto [place, is_first] = last.try_emplace({event.x, event.y}, event.t_us);
    if (!is_first && place->second < 400'000) {
      waits += 1.0;
      short_waits += event.t_us - place->second < 1e6 / mean;
    }
    place->second = event.t_us;
  }
  CHECK(short_waits / waits == Approx(1.0 - std::exp(-1.0)).margin(4.0 * 0.5 / std::sqrt(waits)));
}

TEST_CASE("A noise event makes the pixel forget how far it was from the next threshold") {
  SensorOptions options = ideal_sensor();
  options.shot_hz = 10.0;
  const auto ramp = [](double t_s) { return 1e-3 * std::exp(1.5 * t_s); };
  std::map<std::pair<int, int>, std::int32_t> last;
  int signals = 0;
  for (const SensorEvent& event : record(options, kSensor, ramp, 3'000'000, 1000)) {
    auto& last_us = last[{event.x, event.y}];
    if (event.cause == EventCause::signal) {
      ++signals;  // at 1.5 per s, a threshold of 0.25 takes 167 ms
      REQUIRE(event.t_us - last_us == Approx(166'667).margin(5));
    }
    last_us = event.t_us;
  }
  CHECK(signals > 0);
}

TEST_CASE("Leaks give every pixel ON events at the asked rate, whatever its threshold, for any time step") {
  const std::int32_t step_us = GENERATE(1000, 200);
  const double leak_hz = GENERATE(5.0, 1.0);
  SensorOptions options = ideal_sensor();
  options.leak_hz = leak_hz;
  options.mismatch = 0.04;
  options.random_start = true;
  // After three periods nobody remembers the start. Then each pixel fires once a period.
  const auto period_us = static_cast<std::int32_t>(1e6 / leak_hz);
  const auto events = record(
      options, "32x24", [](double) { return 0.4; }, 7 * period_us, step_us);
  const auto settled = std::count_if(events.begin(), events.end(),
                                     [&](const SensorEvent& e) { return e.t_us >= 3 * period_us; });
  CHECK(static_cast<double>(settled) == Approx(4 * 32 * 24).epsilon(0.001));
  CHECK(share_on(events) == 1.0);
  std::map<std::pair<int, int>, std::int32_t> last;
  for (const SensorEvent& event : events) {
    const auto [place, is_first] = last.try_emplace({event.x, event.y}, event.t_us);
    if (!is_first) REQUIRE(event.t_us - place->second == Approx(period_us).epsilon(1e-4));
    place->second = event.t_us;
  }
}

TEST_CASE(
    "Hot pixels are as many as asked, and fire ON events at rates between the asked ones, for any step") {
  const std::int32_t step_us = GENERATE(1000, 200);
  SensorOptions options = ideal_sensor();
  options.hot_share = 0.1;
  options.hot_min_hz = 20.0;
  options.hot_max_hz = 60.0;
  constexpr double kDuration_s = 2.0;
  const auto events = record(
      options, kSensor, [](double) { return 0.4; }, 2'000'000, step_us);
  CHECK(share_on(events) == 1.0);
  double hot = 0.0, rates = 0.0, squares = 0.0;
  for (const double count : counts_of(events)) {
    if (count == 0.0) continue;
    hot += 1.0;
    rates += count / kDuration_s;
    squares += count / kDuration_s * count / kDuration_s;
  }
  CHECK(std::abs(hot - 0.1 * kPixels) < 4.0 * std::sqrt(0.1 * 0.9 * kPixels));
  const double mean = rates / hot;
  const double variance = 40.0 * 40.0 / 12.0 + 40.0 / kDuration_s;  // uniform rates, then Poisson
  CHECK(std::abs(mean - 40.0) < 4.0 * std::sqrt(variance / hot));
  CHECK(squares / hot - mean * mean == Approx(variance).epsilon(0.25));
}

TEST_CASE("Each source of noise works alone") {
  const auto [name, change] = GENERATE(table<std::string, void (*)(SensorOptions&)>({
      {"shot", [](SensorOptions& o) { o.shot_hz = 3.0; }},
      {"leak", [](SensorOptions& o) { o.leak_hz = 3.0; }},
      {"hot", [](SensorOptions& o) { o.hot_share = 0.1; }},
  }));
  INFO(name);
  SensorOptions options = ideal_sensor();
  change(options);
  CHECK_FALSE(record(
                  options, "20x16", [](double) { return 0.4; }, 1'000'000, 1000)
                  .empty());
}
