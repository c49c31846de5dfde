#include "esi/sim/float_math.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "esi/sim/random.hpp"

using namespace esi;

TEST_CASE("The fast logarithm and exponential are as good as floats are") {
  for (double x = 1e-4; x < 100.0; x *= 1.0007) {
    const auto f = static_cast<float>(x);
    const double log = std::log(static_cast<double>(f));
    REQUIRE(std::abs(fast_log(f) - log) <= 3e-7 * std::max(1.0, std::abs(log)));
  }
  for (double x = 0.0; x < 75.0; x += 0.0013) {
    const auto f = static_cast<float>(x);
    // The argument's own rounding counts x times.
    REQUIRE(fast_exp_minus(f) == Approx(std::exp(-static_cast<double>(f))).epsilon(4e-7 * std::max(1.0, x)));
  }
  CHECK(fast_log(1.0F) == 0.0F);
  CHECK(fast_exp_minus(0.0F) == 1.0F);
  CHECK(fast_exp_minus(1e6F) < 1e-34F);
}

TEST_CASE("Random numbers are uniform and normal, and independent between numbers, keys, streams and seeds") {
  constexpr int kCount = 40000;
  const RandomKey keys[] = {{1, RandomStream::noise, 0},
                            {1, RandomStream::noise, 1},
                            {1, RandomStream::start, 0},
                            {2, RandomStream::noise, 0}};
  const double four_sigma = 4.0 / std::sqrt(kCount);
  for (const RandomKey& key : keys) {
    double mean = 0.0, square = 0.0, next = 0.0, normal_mean = 0.0, normal_square = 0.0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      const double u = (key.uniform(i) - 0.5) * std::sqrt(12.0);
      mean += u / kCount;
      square += u * u / kCount;
      next += u * (key.uniform(i + 1) - 0.5) * std::sqrt(12.0) / kCount;
      const double z = key.normal(i);
      normal_mean += z / kCount;
      normal_square += z * z / kCount;
    }
    CHECK(std::abs(mean) < four_sigma);
    CHECK(std::abs(square - 1.0) < four_sigma);
    CHECK(std::abs(next) < four_sigma);
    CHECK(std::abs(normal_mean) < four_sigma);
    CHECK(std::abs(normal_square - 1.0) < four_sigma * std::sqrt(2.0));
    for (const RandomKey& other : keys) {
      if (&other == &key) continue;
      double product = 0.0;
      for (std::uint64_t i = 0; i < kCount; ++i)
        product += 12.0 * (key.uniform(i) - 0.5) * (other.uniform(i) - 0.5);
      CHECK(std::abs(product / kCount) < four_sigma);
    }
  }
}
