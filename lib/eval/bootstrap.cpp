#include <algorithm>
#include <cmath>
#include <random>

#include "esi/eval/statistics.hpp"

namespace esi {
namespace {

/// sums[i] is the sum of the first i values.
std::vector<double> prefix_sums(std::span<const double> values) {
  std::vector<double> sums{0.0};
  sums.reserve(values.size() + 1);
  for (const double value : values) sums.push_back(sums.back() + value);
  return sums;
}

/// Evenly from 0 to n - 1, the same on every machine (std::uniform_int_distribution is not).
std::size_t draw(std::mt19937_64& random, std::size_t n) {
  return static_cast<std::size_t>(((random() >> 32) * static_cast<std::uint64_t>(n)) >> 32);
}

double resampled_mean(std::span<const double> sums, std::size_t block, std::mt19937_64& random) {
  const std::size_t n = sums.size() - 1;
  double sum = 0.0;
  for (std::size_t taken = 0; taken < n;) {
    const std::size_t length = std::min(block, n - taken);  // the last block is cut
    const std::size_t begin = draw(random, n - block + 1);
    sum += sums[begin + length] - sums[begin];
    taken += length;
  }
  return sum / static_cast<double>(n);
}

}  // namespace

void BootstrapOptions::declare(OptionTable& table) {
  table.real("bootstrap_block", block_s, {0.001, 3600.0}, "s",
             "length of the bootstrap's blocks: frames further apart count as independent");
  table.integer("bootstrap_resamples", resamples, {100, 1000000}, "", "resamples of the bootstrap");
  table.integer("bootstrap_seed", seed, {0, 1'000'000'000}, "", "seed of the bootstrap");
}

std::optional<ConfidenceInterval> bootstrap_mean(std::span<const double> values, std::int64_t block_values,
                                                 const BootstrapOptions& options) {
  const auto block = static_cast<std::size_t>(std::max<std::int64_t>(1, block_values));
  if (values.size() < 2 || values.size() / 2 < block) return std::nullopt;
  const std::vector<double> sums = prefix_sums(values);
  std::mt19937_64 random(static_cast<std::uint64_t>(options.seed));
  std::vector<double> means(static_cast<std::size_t>(options.resamples));
  for (double& value : means) value = resampled_mean(sums, block, random);
  return ConfidenceInterval{*quantile(means, 0.025), *quantile(means, 0.975)};
}

std::optional<ConfidenceInterval> bootstrap_mean(std::span<const double> values,
                                                 std::span<const std::int64_t> times_us,
                                                 const BootstrapOptions& options) {
  std::vector<double> spacings_s;
  for (std::size_t i = 1; i < times_us.size(); ++i) {
    spacings_s.push_back(static_cast<double>(times_us[i] - times_us[i - 1]) / 1e6);
  }
  const double spacing_s = std::max(1e-6, median(std::move(spacings_s)).value_or(options.block_s));
  return bootstrap_mean(values, std::llround(options.block_s / spacing_s), options);
}

}  // namespace esi
