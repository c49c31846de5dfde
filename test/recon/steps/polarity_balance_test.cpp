#include "esi/recon/steps/polarity_balance.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "../balance_reference.hpp"
#include "support/random_events.hpp"

using namespace esi;

namespace {

constexpr SensorSize kSize{6, 4};

std::vector<float> weights_of(PolarityBalance& balance, const std::vector<Event>& events) {
  std::vector<float> weights(events.size(), 1.0F);
  balance.weigh(events, weights);
  return weights;
}

std::vector<float> weights_of(const BalanceOptions& options, const std::vector<Event>& events) {
  PolarityBalance balance(options, kSize);
  return weights_of(balance, events);
}

/// Random events of which so many in 100 are ON.
std::vector<Event> stream(std::size_t count, unsigned percent_on, unsigned seed) {
  auto events = test::random_events({0, 0, kSize.width_px, kSize.height_px}, count, 5, seed);
  std::mt19937 random(seed + 1);
  for (Event& event : events) event.on = random() % 100 < percent_on;
  return events;
}

}  // namespace

TEST_CASE("a pixel's events weigh by what it fired before, in closed form") {
  const BalanceOptions options{.balance = true, .prior = 4.0, .ratio = 1.0, .cap = 63};
  const auto w = weights_of(
      options, {{0, 1, 1, true}, {1, 1, 1, true}, {2, 1, 1, false}, {3, 1, 1, true}, {4, 2, 1, true}});
  CHECK(w[0] == Approx(1.0));                   // sqrt((0+2)/(0+2))
  CHECK(w[1] == Approx(std::sqrt(2.0 / 3.0)));  // one ON before
  CHECK(w[2] == Approx(std::sqrt(4.0 / 2.0)));  // OFF after two ON: the inverse
  CHECK(w[3] == Approx(std::sqrt(3.0 / 4.0)));
  CHECK(w[4] == Approx(1.0));  // another pixel
}

TEST_CASE("a given prior ratio rules a pixel's first events") {
  const BalanceOptions options{.balance = true, .prior = 1000.0, .ratio = 0.25, .cap = 63};
  const auto w = weights_of(options, {{0, 0, 0, true}, {1, 1, 0, false}});
  CHECK(w[0] == Approx(2.0));
  CHECK(w[1] == Approx(0.5));
}

TEST_CASE("what was given is multiplied") {
  PolarityBalance balance({.balance = true, .prior = 8.0, .ratio = 4.0, .cap = 63}, kSize);
  std::vector<float> weights{3.0F};
  balance.weigh(std::vector<Event>{{0, 0, 0, true}}, weights);
  CHECK(weights[0] == Approx(1.5));
}

TEST_CASE("weights agree with the reference in double precision, in calls of any size") {
  const auto [prior, cap, percent_on] = GENERATE(table<double, std::int64_t, unsigned>(
      {{50.0, 63, 37}, {1.0, 63, 80}, {0.1, 2, 50}, {300.0, 31, 3}, {5.0, 17, 100}}));
  for (const auto& ratio : {std::optional<double>(), std::optional<double>(1.7)}) {
    const BalanceOptions options{.balance = true, .prior = prior, .ratio = ratio, .cap = cap};
    const auto events = stream(20000, percent_on, 8);
    test::BalanceReference reference(options, kSize);
    PolarityBalance balance(options, kSize);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < events.size();) {
      const std::size_t count = std::min<std::size_t>(1 + random() % 700, events.size() - i);
      const std::span part(events.data() + i, count);
      for (const float w : weights_of(balance, {part.begin(), part.end()})) {
        REQUIRE(w == Approx(reference.weigh(events[i++])).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("the sensor's own ratio is followed when it changes, over millions of events") {
  const BalanceOptions options{.balance = true, .prior = 1e6, .ratio = std::nullopt, .cap = 2};
  PolarityBalance balance(options, kSize);
  weights_of(balance, stream(3'000'000, 20, 1));
  CHECK(weights_of(balance, {{0, 0, 0, true}})[0] == Approx(2.0).epsilon(0.01));
  weights_of(balance, stream(16'000'000, 50, 2));
  CHECK(weights_of(balance, {{0, 0, 0, true}})[0] == Approx(1.0).epsilon(0.03));
}

TEST_CASE("where thresholds differ, balanced sums stay where plain ones run away") {
  const auto events = stream(30000, 30, 5);
  const auto w = weights_of({.balance = true}, events);
  double plain = 0.0;
  double balanced = 0.0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    plain += events[i].on ? 1.0 : -1.0;
    balanced += events[i].on ? w[i] : -w[i];
  }
  CHECK(plain < -11000);
  CHECK(std::abs(balanced) < 1000);
}
