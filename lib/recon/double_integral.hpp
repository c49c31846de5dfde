#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/time.hpp"
#include "esi/recon/pixel_grid.hpp"
#include "esi/recon/recent_events.hpp"

namespace esi {

/// Pan et al.'s double integral, in the running form of fast EDI: between events everything is constant, so
/// a pixel's integral grows by one product per event. E(t) is the signed number of events of a pixel since
/// the exposure's begin.
class DoubleIntegral {
 public:
  struct Pixel {
    double exp_integral = 0.0;    ///< of exp(c E(t)) over the exposure, us
    double plain_integral = 0.0;  ///< of E(t), us
    std::int64_t t_us = 0;        ///< until when both have been summed
    float e = 0.0F;               ///< E(t_us)
    float e_reference = 0.0F;     ///< E at the reference time
  };

  DoubleIntegral(SensorSize size, std::string_view method) : pixels_(size, {}, method) {}

  /// Integrates over an exposure that isn't empty. `events` are those inside it; begin <= reference <= end.
  void run(std::span<const SignedEvent> events, Interval exposure, std::int64_t reference_us, double c);

  const Pixel* row(int y) const { return pixels_.row(y); }

 private:
  PixelGrid<Pixel> pixels_;
};

}  // namespace esi
