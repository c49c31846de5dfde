#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/decay.hpp"
#include "esi/recon/decay_loss.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Event-based single integration (Dong et al. 2025); see docs/methods.md. c_on and c_off set the unit of E.
struct EsiOptions {
  DecayOptions decay;
  double c_on = 1.0;
  double c_off = 1.0;
  double e_min = -2.0;
  double e_max = 2.0;
  bool readout_decay = false;

  void declare(OptionTable& table);
  /// Throws a usage Error unless e_min <= 0 <= e_max with some range between them.
  void check() const;
};

/// All that ESI keeps of a pixel.
struct EsiPixel {
  float e = 0.0F;         ///< accumulator
  std::int32_t t_us = 0;  ///< last event, counted from the reconstructor's epoch; of no account where e = 0
};

class Esi final : public Reconstructor {
 public:
  /// Throws a usage Error as check() does, and an Error where memory doesn't suffice.
  Esi(const EsiOptions& options, SensorSize size);

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;
  void render(std::int64_t t_us, cv::Mat1b& grey) override;

  /// The same as process(), with each event's weight from weight_of(pixel, on), asked once a piece and in
  /// order. Defined in esi_integrator.hpp.
  template <class Weight>
  Weight accumulate(std::span<const Event> events, Weight weight_of);

  /// Row by row from the top.
  std::span<const EsiPixel> pixels() const { return pixels_; }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override;
  /// The first event of all starts the clock.
  void begin_at(std::int64_t t_us);
  /// How many of the events, from the first on, have times that count from the present epoch.
  std::size_t events_near_epoch(std::span<const Event> events) const;
  void take_epoch(std::int64_t epoch_us);
  /// Counts the pixels' times from an epoch that is this much later.
  void move_epoch(std::int64_t by_us, std::span<EsiPixel> pixels) const;
  /// Makes every pixel of the image shade(E), with E faded to t_us where the options say so.
  template <class Image, class Shade>
  void show(std::int64_t t_us, Image& image, Shade shade) const;
  template <class Image, class Shade>
  void show_decayed(std::int64_t since_epoch_us, Image& image, Shade shade) const;
  std::span<const EsiPixel> row(std::span<const EsiPixel> pixels, int y) const;

  EsiOptions options_;
  SensorSize size_;
  DecayLoss loss_;
  std::vector<EsiPixel> pixels_;
  bool has_events_ = false;
  std::int64_t epoch_us_ = 0;   ///< at first the first event, so that a shift in time changes nothing
  std::int64_t t_last_us_ = 0;  ///< last event
};

}  // namespace esi
