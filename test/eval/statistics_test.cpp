#include "esi/eval/statistics.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace esi;

TEST_CASE("Wilson's interval has the published values") {
  // Newcombe 1998, Statistics in Medicine 17, table I, method 3: 81/263, 15/148, 0/20, 1/29.
  const auto check = [](std::int64_t hits, std::int64_t of, double low, double high) {
    const auto interval = Rate{hits, of}.wilson();
    REQUIRE(interval);
    CHECK(interval->low == Approx(low).margin(5e-5));
    CHECK(interval->high == Approx(high).margin(5e-5));
  };
  check(81, 263, 0.2553, 0.3662);
  check(15, 148, 0.0624, 0.1605);
  check(0, 20, 0.0, 0.1611);
  check(1, 29, 0.0061, 0.1718);
  check(20, 20, 0.8389, 1.0);
  CHECK(Rate{0, 20}.wilson()->low == 0.0);
  CHECK(Rate{20, 20}.wilson()->high == 1.0);
  CHECK_FALSE(Rate{}.wilson());
  CHECK_FALSE(Rate{}.value());
}

TEST_CASE("Quantiles lie linearly between the sorted values") {
  const std::vector<double> values{4, 1, 3, 2};
  CHECK(quantile(values, 0.0) == 1.0);
  CHECK(quantile(values, 1.0) == 4.0);
  CHECK(median(values) == 2.5);
  CHECK(quantile(values, 0.95).value() == Approx(3.85));
  CHECK(quantile({7}, 0.95) == 7.0);
  CHECK(mean(values) == 2.5);
  CHECK_FALSE(median({}));
  CHECK_FALSE(mean({}));
}

TEST_CASE("The bootstrap of independent draws has the width of the normal approximation") {
  std::mt19937_64 random(5);
  std::vector<double> values(4000);
  for (double& value : values) value = random() % 10 < 3 ? 1.0 : 0.0;
  const double p = mean(values).value();
  const auto interval = bootstrap_mean(values, 1);
  REQUIRE(interval);
  const double half = 1.96 * std::sqrt(p * (1 - p) / 4000);
  CHECK(interval->low == Approx(p - half).margin(0.1 * half));
  CHECK(interval->high == Approx(p + half).margin(0.1 * half));
}

TEST_CASE("Where neighbours are alike, longer blocks give the wider interval that is due") {
  std::mt19937_64 random(6);
  std::vector<double> values;
  for (int run = 0; run < 400; ++run) values.insert(values.end(), 25, random() % 2 == 0 ? 1.0 : 0.0);
  const auto width = [&](std::int64_t block) {
    const auto interval = bootstrap_mean(values, block);
    return interval->high - interval->low;
  };
  const double due = 2 * 1.96 * 0.5 / std::sqrt(400.0);
  CHECK(width(1) == Approx(due / 5).epsilon(0.1));
  CHECK(width(250) == Approx(due).epsilon(0.15));
}

TEST_CASE("The bootstrap is the same each time, follows its seed, and needs two blocks") {
  std::vector<double> values(100);
  for (std::size_t i = 0; i < 100; ++i) values[i] = i % 7 == 0 ? 1.0 : 0.0;
  BootstrapOptions other;
  other.seed = 2;
  const auto one = bootstrap_mean(values, 9), again = bootstrap_mean(values, 9);
  CHECK(one->low == again->low);
  CHECK(one->high == again->high);
  const auto reseeded = bootstrap_mean(values, 9, other);
  CHECK((one->low != reseeded->low || one->high != reseeded->high));
  CHECK(bootstrap_mean(values, 50));
  CHECK_FALSE(bootstrap_mean(values, 51));
  CHECK_FALSE(bootstrap_mean(std::vector{1.0}, 1));
  CHECK_FALSE(bootstrap_mean({}, 1));
  const auto any = bootstrap_mean(std::vector{0.0, 1.0}, 1);  // blocks begin at the last value, too
  CHECK(any->low == 0.0);
  CHECK(any->high == 1.0);
  const auto certain = bootstrap_mean(std::vector<double>(50, 1.0), 5);
  CHECK(certain->low == 1.0);
  CHECK(certain->high == 1.0);
}

TEST_CASE("A block has as many values as its duration has at the median spacing") {
  std::vector<double> values;
  std::vector<std::int64_t> times_us;
  for (int i = 0; i < 400; ++i) {
    values.push_back(i / 20 % 2);
    times_us.push_back(10'000 * i + (i >= 200 ? 5'000'000 : 0));
  }
  const auto by_time = bootstrap_mean(values, times_us), by_count = bootstrap_mean(values, 100);
  REQUIRE(by_time);
  CHECK(by_time->low == by_count->low);
  CHECK(by_time->high == by_count->high);
}
