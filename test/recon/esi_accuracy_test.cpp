// The event loop beside a slow reference in double precision.

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "esi_reference.hpp"
#include "random_decays.hpp"
#include "support/random_events.hpp"
#include "support/shared_data.hpp"

using namespace esi;

namespace {

constexpr double kTolerance = 1e-5;  ///< of the clamp's range

/// Such pixels may be decayed in parts, so that E is not that of the last event; decayed to a frame's time,
/// it is.
bool outlasts_an_epoch(const DecayOptions& decay) {
  return decay.decay == Decay::exponential && decay.alpha_hz < 0.02;
}

void check_against_reference(const EsiOptions& options, SensorSize size, const std::vector<Event>& events) {
  Esi esi(options, size);
  test::EsiReference reference(options, size);
  esi.process(events);
  reference.process(events);
  INFO("decay " << static_cast<int>(options.decay.decay) << " tau " << options.decay.tau_s << " n "
                << options.decay.n << " alpha " << options.decay.alpha_hz << " c " << options.c_on << " "
                << options.c_off << " E " << options.e_min << " " << options.e_max);
  if (!options.readout_decay || !outlasts_an_epoch(options.decay)) {
    REQUIRE(test::largest_error(esi, reference, options) < kTolerance);
  }
  cv::Mat1b grey;
  for (const std::int64_t later_us : {1, 10000, 3000000}) {
    const std::int64_t t_us = events.back().t_us + later_us;
    esi.render(t_us, grey);
    REQUIRE(test::largest_grey_error(grey, reference, t_us) < 0.5 + 255 * kTolerance);
  }
}

/// Options drawn at random around a decay.
EsiOptions random_options(const DecayOptions& decay, std::mt19937& random) {
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  EsiOptions options;
  options.decay = decay;
  options.c_on = uniform(0.05, 1.0);
  options.c_off = uniform(0.05, 1.0);
  options.e_min = -uniform(0.1, 5.0);
  options.e_max = uniform(0.1, 5.0);
  options.readout_decay = random() % 2 == 0;
  return options;
}

std::vector<EsiOptions> all_options(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<EsiOptions> all;
  for (const DecayOptions& decay : test::random_decays(count, seed))
    all.push_back(random_options(decay, random));
  return all;
}

/// Lines "seconds x y p", or "us,x,y,p" under a header.
std::vector<Event> read_text(const std::filesystem::path& path) {
  const bool is_csv = path.extension() == ".csv";
  std::ifstream file(path);
  std::string line;
  if (is_csv) std::getline(file, line);
  std::vector<Event> events;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    double t = 0.0;
    int x = 0, y = 0, p = 0;
    if (std::sscanf(line.c_str(), "%lf %d %d %d", &t, &x, &y, &p) != 4) FAIL(line);
    const auto t_us = static_cast<std::int64_t>(is_csv ? t : std::floor(t * 1e6 + 0.5));
    events.push_back({t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), p == 1});
  }
  return events;
}

}  // namespace

TEST_CASE("random events agree with the reference to 1e-5 of the clamp's range") {
  const SensorSize size{8, 6};
  for (const EsiOptions& options : all_options(120, 11)) {
    // From 10 us to minutes between a pixel's events.
    for (const int gap_us : {1, 100, 5000, 400000}) {
      check_against_reference(options, size, test::random_events({0, 0, 8, 6}, 4000, gap_us, 12));
    }
  }
}

TEST_CASE("pixels that fire at 10 kHz and more agree with the reference") {
  const int gap_us = GENERATE(1, 20, 100);
  for (const EsiOptions& options : all_options(60, 13)) {
    check_against_reference(options, {1, 1}, test::random_events({0, 0, 1, 1}, 50000, gap_us, 14));
  }
}

TEST_CASE("a pixel that alternates for ever, never clamped, drifts by less than 2e-4 of the range") {
  // The worst case of a 24-bit E: what a decay takes off between two events is as small as a rounding.
  const std::int64_t gap_us = GENERATE(10, 100, 1000);
  for (const Decay form : {Decay::polynomial, Decay::power, Decay::exponential}) {
    EsiOptions options;
    options.decay = {
        .decay = form, .tau_s = 2.0, .n = 2.0, .alpha_hz = form == Decay::exponential ? 1.0 : 0.0};
    std::vector<Event> events;
    for (std::int64_t i = 0; i < 200000; ++i) events.push_back({i * gap_us, 0, 0, i % 2 == 0});
    Esi esi(options, {1, 1});
    test::EsiReference reference(options, {1, 1});
    esi.process(events);
    reference.process(events);
    CHECK(test::largest_error(esi, reference, options) < 2e-4);
  }
}

TEST_CASE("pixels that rest for hours between bursts agree with the reference") {
  for (EsiOptions options : all_options(60, 15)) {
    options.readout_decay = true;
    std::vector<Event> events;
    std::int64_t begin_us = 0;
    for (const std::int64_t gap_us : {1LL, 900000000LL, 1073741822LL, 1073741823LL, 1073741824LL,
                                      2147483647LL, 2147483648LL, 4294967296LL, 300000000000LL}) {
      begin_us += gap_us;
      for (Event event : test::random_events({0, 0, 4, 4}, 50, 3000, 16)) {
        event.t_us += begin_us;
        events.push_back(event);
      }
      begin_us = events.back().t_us;
    }
    check_against_reference(options, {4, 4}, events);
  }
}

TEST_CASE("one pixel that rests while others keep the clock going agrees with the reference") {
  const std::int64_t rest_us = GENERATE(999000000LL, 1073741824LL, 3000000000LL, 260000000000LL);
  for (EsiOptions options : all_options(40, 17)) {
    if (options.decay.decay == Decay::polynomial) options.decay.tau_s = 1000.0;
    if (options.decay.decay == Decay::exponential) options.decay.alpha_hz = 1e-6;
    std::vector<Event> events{{0, 0, 0, true}, {7, 1, 0, false}};
    for (std::int64_t t_us = 100; t_us < rest_us; t_us += rest_us / 300)
      events.push_back({t_us, 2, 0, t_us % 2 == 0});
    events.push_back({rest_us, 0, 0, true});  // pixel 0 awakes, pixel 1 is only shown
    options.readout_decay = true;
    check_against_reference(options, {3, 1}, events);
  }
}

TEST_CASE("real recordings agree with the reference") {
  const auto [name, width, height] = GENERATE(table<std::string, int, int>(
      {{"txt/slider_depth/events_chunk.txt", 240, 180}, {"tagboard/tagboard.txyp_us.csv", 346, 260}}));
  const auto path = test::shared_data(name);
  if (!path) return;
  const std::vector<Event> events = read_text(*path);
  REQUIRE(events.size() >= 50000);
  for (const Decay form : {Decay::polynomial, Decay::power, Decay::exponential, Decay::none}) {
    EsiOptions options;
    options.decay = {
        .decay = form, .tau_s = 1.5, .n = 2.0, .alpha_hz = form == Decay::polynomial ? 0.0 : 0.7};
    options.readout_decay = true;
    check_against_reference(options, {width, height}, events);
  }
}
