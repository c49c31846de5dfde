#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

// Random numbers without a state: each is a hash of what it is for. So it doesn't matter which thread draws
// first, nor how many others were drawn before.

namespace esi {

/// What a random number decides. Numbers of different streams don't correlate.
enum class RandomStream : std::uint64_t {
  ground = 1,
  obstacle,
  wander,
  on_mismatch,
  off_mismatch,
  hot_pixel,
  start,
  noise,
  read_noise,
};

/// The key of a family of random numbers, such as all that concern one pixel.
class RandomKey {
 public:
  RandomKey(std::int64_t seed, RandomStream stream, std::uint64_t index = 0)
      : key_(mixed(mixed(static_cast<std::uint64_t>(seed) ^ static_cast<std::uint64_t>(stream) << 56) +
                   index)) {}

  /// The n-th number of the family, 64 random bits.
  std::uint64_t bits(std::uint64_t n) const { return mixed(key_ ^ mixed(n)); }

  /// Uniform in (0, 1), never 0 or 1.
  double uniform(std::uint64_t n) const { return (static_cast<double>(bits(n) >> 12) + 0.5) * 0x1p-52; }
  double uniform(std::uint64_t n, double low, double high) const { return low + (high - low) * uniform(n); }

  /// Mean 0, deviation 1; takes the numbers 2n and 2n + 1 (Box & Muller 1958).
  double normal(std::uint64_t n) const {
    const double radius = std::sqrt(-2.0 * std::log(uniform(2 * n)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(2 * n + 1));
  }

 private:
  // The output function of SplitMix64 (Steele, Lea & Flood 2014), after one step of its counter.
  static std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t key_;
};

}  // namespace esi
