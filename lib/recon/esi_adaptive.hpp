#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "esi/recon/esi.hpp"
#include "esi/recon/steps/event_filters.hpp"
#include "esi/recon/steps/polarity_balance.hpp"
#include "esi/recon/steps/tone.hpp"

namespace esi {

/// ESI with blocks against noise; see docs/methods.md. Each gives what the step of the same name gives around
/// plain ESI, but for less time.
struct EsiAdaptiveOptions {
  EsiOptions esi{.decay = {}, .e_min = -3.0, .e_max = 3.0};
  BalanceOptions balance{.balance = true};
  std::int64_t background_us = 0;  ///< 0: off
  SmoothingOptions smoothing{.median = false, .blur_px = 0.7};

  void declare(OptionTable& table);
};

class EsiAdaptive final : public Reconstructor {
 public:
  EsiAdaptive(const EsiAdaptiveOptions& options, SensorSize size);

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override;
  void integrate(std::span<const Event> events, std::span<const float> weights);

  Esi esi_;
  std::optional<BackgroundFilter> background_;
  std::optional<PolarityBalance> balance_;
  Smoothing smoothing_;
  std::vector<Event> kept_;
  std::vector<float> kept_weights_;
};

}  // namespace esi
