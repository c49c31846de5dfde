#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/exponential_loss.hpp"
#include "esi/recon/pixel_grid.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// How a potential returns to neutral.
enum class AccumulatorDecay {
  exponential,  ///< V - V0 falls by exp(-dt / tau)
  linear,       ///< |V - V0| falls by slope * dt, down to 0
  step,         ///< V is V0 once more than a given time has passed since the pixel's last event
  none,
};

/// The leaky accumulator of a camera's own viewer; see docs/methods.md. Defaults are dv-processing's.
struct AccumulatorOptions {
  AccumulatorDecay decay = AccumulatorDecay::exponential;
  double tau_s = 1.0;
  double slope_hz = 1.0;
  double step_s = 1.0;
  double contribution = 0.15;
  double v_min = 0.0;
  double v_max = 1.0;
  double v_neutral = 0.0;
  bool readout_decay = false;

  void declare(OptionTable& table);
  /// Throws a usage Error unless v_min <= v_neutral <= v_max with some range between the bounds.
  void check() const;
};

class Accumulator final : public Reconstructor {
 public:
  /// Throws a usage Error as check() does, and an Error where memory doesn't suffice.
  Accumulator(const AccumulatorOptions& options, SensorSize size);

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

 private:
  struct Pixel {
    double v = 0.0;         ///< potential above neutral
    std::int64_t t_us = 0;  ///< last event; of no account where v = 0
  };

  void take(std::span<const Event> events, std::span<const float> weights) override;
  /// Calls `use` with the decay: a function of a potential above neutral and a time that passed.
  template <class Use>
  void with_decay(Use use) const;

  AccumulatorOptions options_;
  SensorSize size_;
  ExponentialLoss loss_;
  PixelGrid<Pixel> pixels_;
  std::int64_t t_last_us_ = 0;  ///< last event
};

}  // namespace esi
