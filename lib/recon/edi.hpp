#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string_view>

#include "esi/recon/deblur.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// What the two forms of the event-based double integral share: a sharp image for each intensity frame.
class EdiBase : public Reconstructor {
 public:
  void observe(const IntensityFrame& frame) final { deblur_.observe(frame); }
  /// Mid-grey before the first intensity frame.
  void render_levels(std::int64_t t_us, cv::Mat1f& levels) final;

  /// The contrast threshold in use.
  double contrast() const { return deblur_.contrast(); }

 protected:
  EdiBase(const EdiOptions& options, SensorSize size, std::string_view method)
      : size_(size), deblur_(options, size, method) {}
  const Deblur& deblur() const { return deblur_; }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) final {
    deblur_.take(events, weights);
  }
  /// The logarithm of what is shown, as a share of white. There is a frame.
  virtual cv::Mat1f log_shown() const = 0;

  SensorSize size_;
  Deblur deblur_;
};

/// The event-based double integral (Pan et al. 2019): the latest sharp image.
class Edi final : public EdiBase {
 public:
  Edi(const EdiOptions& options, SensorSize size) : EdiBase(options, size, "edi") {}

 private:
  cv::Mat1f log_shown() const override { return deblur().log_sharp(); }
};

/// The same, and between intensity frames the image moves on with the events: I(t) = I(f) exp(c E(f -> t)).
class EdiPropagated final : public EdiBase {
 public:
  EdiPropagated(const EdiOptions& options, SensorSize size) : EdiBase(options, size, "edi-propagated") {}

 private:
  cv::Mat1f log_shown() const override;
};

}  // namespace esi
