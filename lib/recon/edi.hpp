#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/recon/deblur.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// The event-based double integral (Pan et al. 2019): one sharp image per intensity frame. It shows the
/// latest one; mid-grey before the first.
class Edi final : public Reconstructor {
 public:
  Edi(const EdiOptions& options, SensorSize size) : size_(size), deblur_(options, size, "edi") {}

  void observe(const IntensityFrame& frame) override { deblur_.observe(frame); }
  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

  /// The contrast threshold in use.
  double contrast() const { return deblur_.contrast(); }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override {
    deblur_.take(events, weights);
  }

  SensorSize size_;
  Deblur deblur_;
};

/// The same, and between intensity frames the image moves on with the events: I(t) = I(f) exp(c E(f -> t)).
class EdiPropagated final : public Reconstructor {
 public:
  EdiPropagated(const EdiOptions& options, SensorSize size)
      : size_(size), deblur_(options, size, "edi-propagated") {}

  void observe(const IntensityFrame& frame) override { deblur_.observe(frame); }
  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;

  double contrast() const { return deblur_.contrast(); }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override {
    deblur_.take(events, weights);
  }

  SensorSize size_;
  Deblur deblur_;
};

}  // namespace esi
