#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/options.hpp"

namespace esi {

/// 95 % confidence.
struct ConfidenceInterval {
  double low = 0.0, high = 0.0;
};

/// `hits` of `of` that could have been.
struct Rate {
  std::int64_t hits = 0, of = 0;

  std::optional<double> value() const;  ///< nothing of nothing is no rate
  /// Wilson (1927), for draws that are independent of each other; frames 10 ms apart are not.
  std::optional<ConfidenceInterval> wilson() const;
};

/// p of 0 to 1, linear between the sorted values (Hyndman & Fan's type 7, as numpy does); NaN is not allowed.
std::optional<double> quantile(std::vector<double> values, double p);
std::optional<double> median(std::vector<double> values);
std::optional<double> mean(std::span<const double> values);

struct BootstrapOptions {
  double block_s = 1.0;
  std::int64_t resamples = 2000;
  std::int64_t seed = 1;

  void declare(OptionTable& table);
};

/// Percentile interval of the mean of a series whose neighbours depend on each other: the moving-block
/// bootstrap (Kuensch 1989). Resamples are put together from blocks of so many values in a row. Nothing for
/// fewer values than two blocks have. The same values and options give the same interval.
std::optional<ConfidenceInterval> bootstrap_mean(std::span<const double> values, std::int64_t block_values,
                                                 const BootstrapOptions& options = {});

/// The same for a series in time, which ascends; a block has as many values as its duration has at the
/// median spacing.
std::optional<ConfidenceInterval> bootstrap_mean(std::span<const double> values,
                                                 std::span<const std::int64_t> times_us,
                                                 const BootstrapOptions& options = {});

}  // namespace esi
