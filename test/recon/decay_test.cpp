#include "esi/recon/decay.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "esi/recon/decay_loss.hpp"
#include "random_decays.hpp"

using namespace esi;

namespace {

DecayOptions decay_of(Decay form, double tau_s, double n, double alpha_hz) {
  DecayOptions options;
  options.decay = form;
  options.tau_s = tau_s;
  options.n = n;
  options.alpha_hz = alpha_hz;
  return options;
}

/// How long something is left of an event, or a while where that is for ever.
double memory_us(const DecayOptions& decay) {
  const double rate_hz = decay.decay == Decay::none ? 0.0 : decay.alpha_hz;
  return std::min({support_us(decay), 20e6 / std::max(rate_hz, 1e-9), 1.9e9});
}

/// Whole microseconds of every size: all up to 300, then evenly in their logarithms up to `end_us`.
std::vector<std::int32_t> times_up_to(double end_us, std::mt19937& random) {
  std::vector<std::int32_t> times;
  for (std::int32_t t = 0; t <= 300 && t <= end_us; ++t) times.push_back(t);
  for (int i = 0; i < 3000; ++i) {
    times.push_back(
        static_cast<std::int32_t>(std::pow(end_us, static_cast<double>(random()) / 4294967296.0)));
  }
  return times;
}

double loss_at(const DecayLoss& loss, std::int32_t dt_us) {
  return std::visit([dt_us](const auto& form) { return static_cast<double>(form(dt_us)); }, loss);
}

}  // namespace

TEST_CASE("gamma has the values that its formulas give by hand") {
  struct Row {
    DecayOptions decay;
    double dt_us;
    double gamma;
  };
  const auto row = GENERATE(Row{decay_of(Decay::polynomial, 2.0, 1.0, 0.0), 0.5e6, 0.75},
                            Row{decay_of(Decay::polynomial, 2.0, 3.0, 0.0), 1.0e6, 0.125},
                            Row{decay_of(Decay::polynomial, 2.0, 1.0, std::log(2.0)), 1.0e6, 0.25},
                            Row{decay_of(Decay::power, 2.0, 2.0, 0.0), 1.0e6, 0.75},
                            Row{decay_of(Decay::power, 2.0, 3.0, std::log(2.0)), 1.0e6, 0.4375},
                            Row{decay_of(Decay::exponential, 2.0, 3.0, std::log(2.0)), 3.0e6, 0.125},
                            Row{decay_of(Decay::none, 2.0, 3.0, std::log(2.0)), 3.0e6, 1.0},
                            Row{decay_of(Decay::polynomial, 2.0, 1.5, 0.0), 1999999.0, 3.5355339059e-10},
                            Row{decay_of(Decay::polynomial, 2.0, 1.5, 0.0), 2e6, 0.0},
                            Row{decay_of(Decay::power, 2.0, 2.5, 0.0), 2e6, 0.0},
                            Row{decay_of(Decay::polynomial, 2.0, 2.0, 0.0), 9e6, 0.0},
                            Row{decay_of(Decay::power, 2.0, 2.0, 0.0), 9e6, 0.0});
  CHECK(gamma(row.decay, row.dt_us) == Approx(row.gamma).margin(1e-15));
}

TEST_CASE("gamma starts at 1, falls, and is 0 from the end of its support on") {
  std::mt19937 random(1);
  for (const DecayOptions& decay : test::random_decays(400, 2)) {
    const bool is_finite = decay.decay == Decay::polynomial || decay.decay == Decay::power;
    REQUIRE(gamma(decay, 0.0) == 1.0);
    REQUIRE(std::isfinite(support_us(decay)) == is_finite);
    auto times = times_up_to(memory_us(decay) * 1.1, random);
    std::sort(times.begin(), times.end());
    int wrong = 0;
    double previous = 1.0;
    for (const std::int32_t t_us : times) {
      const double now = gamma(decay, t_us);
      const bool is_over = t_us >= support_us(decay);
      wrong += now < 0.0 || now > previous || (is_over && now != 0.0);
      previous = now;
    }
    REQUIRE(wrong == 0);
    if (is_finite && decay.alpha_hz == 0.0) REQUIRE(gamma(decay, support_us(decay) * 0.99) > 0.0);
  }
}

TEST_CASE("many short gaps decay less than one long gap") {
  std::mt19937 random(3);
  for (const DecayOptions& decay : test::random_decays(400, 4)) {
    const auto a = times_up_to(memory_us(decay), random);
    const auto b = times_up_to(memory_us(decay), random);
    double least = 1.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double together = gamma(decay, static_cast<double>(a[i]) + b[i]);
      least = std::min(least, gamma(decay, a[i]) * gamma(decay, b[i]) - together);
    }
    REQUIRE(least >= -1e-12);
  }
}

TEST_CASE(
    "the event loop's decay is within 8e-6 of the exact one, and tiny losses within 1e-4 of themselves") {
  std::mt19937 random(5);
  double worst = 0.0;
  double worst_blunt = 0.0;
  double worst_relative = 0.0;
  for (const DecayOptions& decay : test::random_decays(400, 6)) {
    const DecayLoss loss = loss_of(decay);
    for (const std::int32_t t_us : times_up_to(memory_us(decay) * 1.01, random)) {
      const double exact = decay_loss(decay, t_us);
      const double error = std::abs(loss_at(loss, t_us) - exact);
      // The curvature of (1 - u)^n is infinite at u = 1 for 1 < n < 2, which costs the last cell accuracy.
      const bool is_blunt =
          decay.decay == Decay::polynomial && decay.n < 2.0 && t_us > 0.99 * support_us(decay);
      if (is_blunt) {
        worst_blunt = std::max(worst_blunt, error);
      } else {
        worst = std::max(worst, error);
      }
      if (exact > 1e-7) worst_relative = std::max(worst_relative, error / exact);
    }
  }
  CHECK(worst < 8e-6);
  CHECK(worst_blunt < 2e-5);
  CHECK(worst_relative < 1e-4);
}

TEST_CASE("the exact formula and its loss agree") {
  std::mt19937 random(7);
  for (const DecayOptions& decay : test::random_decays(100, 8)) {
    double worst = 0.0;
    for (const std::int32_t t_us : times_up_to(memory_us(decay), random)) {
      worst = std::max(worst, std::abs(decay_loss(decay, t_us) - (1.0 - gamma(decay, t_us))));
    }
    REQUIRE(worst < 1e-12);
  }
}

TEST_CASE("the event loop's decay is exactly 0 at once and exactly 1 when forgotten") {
  constexpr std::int32_t kLongest_us = 2147483646;
  for (const DecayOptions& decay : test::random_decays(800, 9)) {
    const DecayLoss loss = loss_of(decay);
    REQUIRE(loss_at(loss, 0) == 0.0);
    if (!std::isfinite(support_us(decay))) continue;
    const auto end_us = static_cast<std::int32_t>(std::ceil(support_us(decay)));
    for (const std::int32_t t_us : {end_us, end_us + 1, end_us + 1000, 2 * end_us, kLongest_us}) {
      REQUIRE(loss_at(loss, t_us) == 1.0);
    }
    if (decay.alpha_hz == 0.0 && decay.n < 2.0) REQUIRE(loss_at(loss, end_us - end_us / 100) < 1.0);
  }
  CHECK(loss_at(loss_of(decay_of(Decay::none, 1.0, 1.0, 5.0)), kLongest_us) == 0.0);
  CHECK(loss_at(loss_of(decay_of(Decay::exponential, 1.0, 1.0, 0.0)), kLongest_us) == 0.0);
}

TEST_CASE("a slow exponential is right up to the longest time") {
  const DecayOptions decay = decay_of(Decay::exponential, 1.0, 1.0, 0.001);
  const DecayLoss loss = loss_of(decay);
  for (const std::int32_t t_us : {1000000, 100000000, 1073741823, 2147483646}) {
    CHECK(loss_at(loss, t_us) == Approx(-std::expm1(-1e-9 * t_us)).epsilon(1e-5));
  }
}

TEST_CASE("the closed form and the table agree where both exist") {
  std::mt19937 random(10);
  for (const Decay form : {Decay::polynomial, Decay::power}) {
    for (const double n : {1.0, 2.0, 3.0}) {
      const DecayOptions decay = decay_of(form, 1.7, n, 0.0);
      const auto cubic = CubicLoss::of(decay);
      REQUIRE(cubic);
      const TableLoss table(decay);
      double worst = 0.0;
      for (const std::int32_t t_us : times_up_to(2e6, random)) {
        worst = std::max(worst, static_cast<double>(std::abs((*cubic)(t_us)-table(t_us))));
      }
      REQUIRE(worst < 5e-6);
    }
  }
  CHECK_FALSE(CubicLoss::of(decay_of(Decay::power, 1.0, 2.0, 0.5)));
  CHECK_FALSE(CubicLoss::of(decay_of(Decay::power, 1.0, 2.5, 0.0)));
  CHECK_FALSE(CubicLoss::of(decay_of(Decay::exponential, 1.0, 2.0, 0.0)));
}
