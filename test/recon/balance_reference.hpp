#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "esi/recon/steps/polarity_balance.hpp"

namespace esi::test {

/// The polarity balance in the words of docs/methods.md: slow, in double precision.
class BalanceReference {
 public:
  BalanceReference(const BalanceOptions& options, SensorSize size)
      : o_(options),
        width_(static_cast<std::size_t>(size.width_px)),
        pixels_(width_ * static_cast<std::size_t>(size.height_px)) {}

  double weigh(const Event& event) {
    Counts& n = pixels_[event.y * width_ + event.x];
    const double r = o_.ratio.value_or(ratio_);
    const double w_on = std::sqrt((n.off + o_.prior / (1 + r)) / (n.on + o_.prior * r / (1 + r)));
    (event.on ? n.on : n.off) += 1;
    if (std::max(n.on, n.off) >= static_cast<double>(o_.cap)) {
      n = {std::floor(n.off / 2), std::floor(n.on / 2)};
    }
    look_at_sensor(event.on);
    return event.on ? w_on : 1.0 / w_on;
  }

 private:
  struct Counts {
    double off = 0, on = 0;
  };

  /// After 256 events, 512 more, 1024 more, ... and every 2^18.
  void look_at_sensor(bool on) {
    (on ? sensor_.on : sensor_.off) += 1;
    if (--until_ > 0) return;
    ratio_ = std::clamp((sensor_.on + 1) / (sensor_.off + 1), 1.0 / 16, 16.0);
    if (sensor_.on + sensor_.off >= 4194304)
      sensor_ = {std::floor(sensor_.off / 2), std::floor(sensor_.on / 2)};
    interval_ = std::min(2 * interval_, 262144);
    until_ = interval_;
  }

  BalanceOptions o_;
  std::size_t width_;
  std::vector<Counts> pixels_;
  Counts sensor_;
  double ratio_ = 1.0;
  int interval_ = 256;
  int until_ = 256;
};

}  // namespace esi::test
