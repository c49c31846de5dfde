#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string_view>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/exponential_loss.hpp"
#include "esi/recon/pixel_grid.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// What the filter is with and without intensity frames; see docs/methods.md.
struct HighPassOptions {
  double cutoff_hz = 0.5;
  double c_on = 0.1;
  double c_off = 0.1;
  double show_min = -0.1;
  double show_max = 1.2;

  void declare(OptionTable& table);
  /// Throws a usage Error unless show_min < show_max.
  void check() const;
};

struct ComplementaryOptions : HighPassOptions {
  bool spare_saturated = false;

  void declare(OptionTable& table);
};

/// The complementary filter (Scheerlinck et al. 2018): events tell the changes, intensity frames the level.
class Complementary : public Reconstructor {
 public:
  /// Throws a usage Error as check() does, and an Error where memory doesn't suffice.
  Complementary(const ComplementaryOptions& options, SensorSize size)
      : Complementary(options, size, "complementary") {}

  /// Throws an Error where the frame isn't of the sensor's size.
  void observe(const IntensityFrame& frame) override;
  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

 protected:
  Complementary(const ComplementaryOptions& options, SensorSize size, std::string_view method);

 private:
  struct Pixel {
    double l;                ///< log intensity at t_us
    std::int64_t t_us = 0;   ///< last event or frame; of no account where l is the reference
    float reference;         ///< what l decays to
    float cutoff_share = 1;  ///< of the cutoff frequency
  };

  void take(std::span<const Event> events, std::span<const float> weights) override;
  /// L at a time that is not before the pixel's last.
  double level_at(const Pixel& pixel, std::int64_t t_us) const;

  ComplementaryOptions options_;
  SensorSize size_;
  ExponentialLoss loss_;
  PixelGrid<Pixel> pixels_;
  std::int64_t t_last_us_;  ///< last event or frame
};

/// The same for events alone: L decays to a constant, which makes it a high-pass filter.
class HighPass final : public Complementary {
 public:
  HighPass(const HighPassOptions& options, SensorSize size) : Complementary({options}, size, "highpass") {}

  void observe(const IntensityFrame& /*frame*/) override {}
};

}  // namespace esi
