#include "esi/recon/steps/polarity_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace esi {
namespace {

/// The sensor's ratio is looked at after so many events at first, then ever more rarely, up to the second.
constexpr std::size_t kFirstInterval = 256;
constexpr std::size_t kLastInterval = std::size_t{1} << 18;
/// The sensor's counts are halved here: some seconds of events, so that a ratio that changes is followed.
constexpr std::int64_t kSensorCap = 1 << 22;
/// Beyond it polarity means nothing.
constexpr double kLargestRatio = 16.0;

}  // namespace

void BalanceOptions::declare(OptionTable& table) {
  table.toggle("balance", balance,
               "let a pixel's ON and OFF events weigh by how rare they are: thresholds differ");
  table.real("balance_prior", prior, {0.1, 1e6}, "", "events that the prior ON/OFF ratio counts as");
  table.optional_real("balance_ratio", ratio, {1.0 / kLargestRatio, kLargestRatio}, "",
                      "prior ON/OFF ratio; none: that of the whole sensor so far");
  table.integer("balance_cap", cap, {2, 63}, "", "a pixel's counts are halved when one reaches it");
}

PolarityBalance::PolarityBalance(const BalanceOptions& options, SensorSize size)
    : options_(options),
      width_px_(static_cast<std::uint32_t>(size.width_px)),
      codes_(std::size_t{width_px_} * static_cast<std::size_t>(size.height_px)),
      outcomes_(2 * kCodes),
      interval_(options.ratio ? std::numeric_limits<std::size_t>::max() : kFirstInterval),
      until_update_(interval_) {
  for (std::size_t code = 0; code < kCodes; ++code) {
    const std::size_t off = code % kCounts;
    const std::size_t on = code / kCounts;
    outcomes_[code].code = next_code(off + 1, on);
    outcomes_[kCodes + code].code = next_code(off, on + 1);
  }
  set_ratio(options.ratio.value_or(1.0));
}

void PolarityBalance::weigh(std::span<const Event> events, std::span<float> weights) {
  while (!events.empty()) {
    const std::size_t part = std::min(events.size(), until_update());
    Kernel weight_of = kernel();
    for (std::size_t i = 0; i < part; ++i) {
      weights[i] *= weight_of(events[i].y * width_px_ + events[i].x, events[i].on);
    }
    take_back(weight_of, part);
    events = events.subspan(part);
    weights = weights.subspan(part);
  }
}

PolarityBalance::Kernel PolarityBalance::kernel() {
  Kernel kernel;
  kernel.codes_ = codes_.data();
  kernel.outcomes_ = outcomes_.data();
  return kernel;
}

void PolarityBalance::take_back(const Kernel& kernel, std::size_t events) {
  if (options_.ratio) return;
  sensor_counts_[1] += static_cast<std::int64_t>(kernel.on_);
  sensor_counts_[0] += static_cast<std::int64_t>(events - kernel.on_);
  until_update_ -= events;
  if (until_update_ > 0) return;
  set_ratio(std::clamp(
      (static_cast<double>(sensor_counts_[1]) + 1.0) / (static_cast<double>(sensor_counts_[0]) + 1.0),
      1.0 / kLargestRatio, kLargestRatio));
  if (sensor_counts_[0] + sensor_counts_[1] >= kSensorCap) {
    for (std::int64_t& count : sensor_counts_) count /= 2;
  }
  interval_ = std::min(2 * interval_, kLastInterval);
  until_update_ = interval_;
}

void PolarityBalance::set_ratio(double ratio) {
  const double prior_off = options_.prior / (1.0 + ratio);
  const double prior_on = prior_off * ratio;
  std::array<double, kCounts> root_off{};
  std::array<double, kCounts> root_on{};
  for (std::size_t n = 0; n < kCounts; ++n) {
    root_off[n] = std::sqrt(static_cast<double>(n) + prior_off);
    root_on[n] = std::sqrt(static_cast<double>(n) + prior_on);
  }
  for (std::size_t on = 0; on < kCounts; ++on) {
    for (std::size_t off = 0; off < kCounts; ++off) {
      const std::size_t code = on * kCounts + off;
      outcomes_[code].weight = static_cast<float>(root_on[on] / root_off[off]);
      outcomes_[kCodes + code].weight = static_cast<float>(root_off[off] / root_on[on]);
    }
  }
}

std::uint16_t PolarityBalance::next_code(std::size_t off, std::size_t on) const {
  const auto cap = static_cast<std::size_t>(options_.cap);
  const bool is_full = off >= cap || on >= cap;
  const std::size_t divisor = is_full ? 2 : 1;
  return static_cast<std::uint16_t>(std::min(on / divisor, kCounts - 1) * kCounts +
                                    std::min(off / divisor, kCounts - 1));
}

}  // namespace esi
