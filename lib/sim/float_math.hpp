#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

// Logarithm and exponential without branches and tables, so that loops over pixels become vector code. They
// give the same bits on every machine, which the C library's don't promise.

namespace esi {

/// ln(x) for normal x > 0; error below 3e-7 of 1, or of the result where that is larger.
inline float fast_log(float x) {
  // x = 2^n m with m from 1/sqrt(2) to sqrt(2), then ln m = 2 artanh((m - 1) / (m + 1)).
  constexpr std::uint32_t kRootHalf = std::bit_cast<std::uint32_t>(0.70710678F);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x) - kRootHalf;
  const auto n = static_cast<float>(static_cast<std::int32_t>(bits) >> 23);
  const float m = std::bit_cast<float>((bits & 0x7fffffU) + kRootHalf);
  const float s = (m - 1.0F) / (m + 1.0F);
  const float q = s * s;
  const float series = 1.0F + q * (1.0F / 3.0F + q * (1.0F / 5.0F + q * (1.0F / 7.0F + q * (1.0F / 9.0F))));
  return n * 0.693147181F + 2.0F * s * series;
}

/// exp(-x) for x >= 0; error below 3e-7 of the result, which ends at 1e-35.
inline float fast_exp_minus(float x) {
  const float clipped = std::min(x, 80.0F);
  const auto n = static_cast<std::int32_t>(clipped * 1.44269504F + 0.5F);  // exp(-x) = 2^-n exp(r)
  const float r = static_cast<float>(n) * 0.693147181F - clipped;
  const float series =
      1.0F +
      r * (1.0F + r / 2.0F * (1.0F + r / 3.0F * (1.0F + r / 4.0F * (1.0F + r / 5.0F * (1.0F + r / 6.0F)))));
  return series * std::bit_cast<float>((127 - n) << 23);
}

}  // namespace esi
