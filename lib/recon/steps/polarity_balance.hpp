#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"

namespace esi {

/// Where a camera's ON and OFF thresholds differ, at a pixel or everywhere, sums of events run away to one
/// side. In the long run a pixel darkens as much as it brightens, so what it has fired tells how much each of
/// its events stands for:
///   w_on = sqrt((N_off + k_off) / (N_on + k_on)),   w_off = 1 / w_on
/// N_on, N_off are the pixel's earlier events; k_on + k_off = prior, k_on / k_off = the prior ratio.
struct BalanceOptions {
  bool balance = false;
  double prior = 50.0;                         ///< events that the prior ratio counts as
  std::optional<double> ratio = std::nullopt;  ///< prior ON/OFF; nothing: that of the whole sensor so far
  std::int64_t cap = 63;                       ///< a count that reaches it halves both of the pixel

  void declare(OptionTable& table);
};

/// The two counts of a pixel are one number of 12 bits, so that weight and next counts are one look-up.
class PolarityBalance {
 public:
  PolarityBalance(const BalanceOptions& options, SensorSize size);

  /// Multiplies each event's weight, one a piece, with what it stands for, and counts the events.
  void weigh(std::span<const Event> events, std::span<float> weights);

  /// The same for event loops that weigh as they go: take kernel()s, each for at most until_update() events,
  /// and give them back with how many there were.
  class Kernel;
  Kernel kernel();
  std::size_t until_update() const { return until_update_; }
  void take_back(const Kernel& kernel, std::size_t events);

 private:
  static constexpr std::size_t kBits = 6;
  static constexpr std::size_t kCounts = std::size_t{1} << kBits;
  static constexpr std::size_t kCodes = kCounts * kCounts;  ///< code = N_on * kCounts + N_off

  /// What an event brings about at a pixel.
  struct Outcome {
    float weight;
    std::uint16_t code;  ///< the pixel's next
  };

  void set_ratio(double ratio);
  std::uint16_t next_code(std::size_t off, std::size_t on) const;

  BalanceOptions options_;
  std::uint32_t width_px_;
  std::vector<std::uint16_t> codes_;
  std::vector<Outcome> outcomes_;                ///< of an OFF event by code, then of an ON event
  std::array<std::int64_t, 2> sensor_counts_{};  ///< OFF, ON
  std::size_t interval_;                         ///< events between updates of the sensor's ratio
  std::size_t until_update_;
};

/// Weighs and counts at one pixel. A value, so that a loop can keep it in registers.
class PolarityBalance::Kernel {
 public:
  /// `pixel` counts row by row.
  float operator()(std::uint32_t pixel, bool on) {
    const auto polarity = static_cast<std::size_t>(on);  // no branch on it: it looks random
    on_ += polarity;
    const Outcome& outcome = outcomes_[polarity * kCodes + codes_[pixel]];
    codes_[pixel] = outcome.code;
    return outcome.weight;
  }

  void prefetch(std::uint32_t pixel) const { __builtin_prefetch(codes_ + pixel, 1); }

 private:
  friend class PolarityBalance;
  std::uint16_t* codes_;
  const Outcome* outcomes_;
  std::size_t on_ = 0;  ///< ON events seen
};

}  // namespace esi
