#include "esi/recon/deblur.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"
#include "esi/recon/intensity.hpp"

namespace esi {
namespace {

/// The logarithm of black: half a grey level of 8 bits.
constexpr double kBlack = 0.5 / 255.0;
/// Pixels beyond these shares of white don't tell how much light there was.
constexpr double kUnderexposed = 16.0 / 255.0;
constexpr double kOverexposed = 240.0 / 255.0;

std::int64_t time_in(Interval exposure, ReferenceTime reference) {
  if (reference == ReferenceTime::start) return exposure.begin_us;
  if (reference == ReferenceTime::end) return exposure.end_us;
  return exposure.begin_us + exposure.duration_us() / 2;
}

}  // namespace

void EdiOptions::declare(OptionTable& table) {
  table.optional_real(
      "contrast", contrast, {0.001, 2.0}, "",
      "contrast threshold c of the camera; none: estimated from the frames and events so far");
  table.choice("reference", reference, {"start", "middle", "end"},
               "the time within an exposure at which its sharp image stands");
}

Deblur::Deblur(const EdiOptions& options, SensorSize size, std::string_view method)
    : options_(options),
      size_(size),
      method_(method),
      recent_(kLongestExposure_us),
      integral_(size, method),
      contrast_(options.contrast.value_or(kFirstContrast)) {
  sharp_.events_since = cv::Mat1f::zeros(size.height_px, size.width_px);
}

void Deblur::take(std::span<const Event> events, std::span<const float> weights) {
  recent_.add(events, weights);
  cv::Mat1f& since = sharp_.events_since;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const float weight = weights.empty() ? 1.0F : weights[i];
    since(events[i].y, events[i].x) += events[i].on ? weight : -weight;
  }
}

void Deblur::observe(const IntensityFrame& frame) {
  const cv::Mat1f shares = relative_intensity(frame, size_, method_);
  Interval exposure = frame.exposure;
  if (exposure.is_empty()) exposure.begin_us = exposure.end_us;
  if (exposure.duration_us() > kLongestExposure_us) {
    throw Error(
        fmt::format("{}: the intensity frame at {} s was exposed for {} s; more than {} s are not kept",
                    method_, seconds_text(exposure.end_us), seconds_text(exposure.duration_us()),
                    kLongestExposure_us / 1'000'000));
  }
  Sharp sharp = deblur(shares, exposure);
  if (has_frame_ && !options_.contrast) {
    estimate_contrast(sharp);
    sharp = deblur(shares, exposure);
  }
  sharp_ = std::move(sharp);
  has_frame_ = true;
}

Deblur::Sharp Deblur::deblur(const cv::Mat1f& shares, Interval exposure) {
  Sharp sharp;
  cv::log(cv::max(shares, kBlack), sharp.log_blurred);
  cv::inRange(shares, kUnderexposed, kOverexposed, sharp.is_usable);
  sharp.log_sharp = sharp.log_blurred.clone();
  sharp.events_since = cv::Mat1f::zeros(shares.size());
  sharp.mean_events = cv::Mat1f::zeros(shares.size());
  if (!exposure.is_empty()) integrate(exposure, sharp);
  const Interval after{exposure.end_us, std::numeric_limits<std::int64_t>::max()};
  for (const SignedEvent& event : recent_.within(after)) sharp.events_since(event.y, event.x) += event.p;
  return sharp;
}

// B = I(f) / X * integral of exp(c E(f -> t)), hence log I(f) = log B - log(mean of exp(c E)) + c E(f), where
// the E that is integrated counts from the exposure's begin.
void Deblur::integrate(Interval exposure, Sharp& sharp) {
  const double c = contrast_;
  const auto duration_us = static_cast<double>(exposure.duration_us());
  integral_.run(recent_.within(exposure), exposure, time_in(exposure, options_.reference), c);
  for (int y = 0; y < size_.height_px; ++y) {
    const DoubleIntegral::Pixel* const pixels = integral_.row(y);
    for (int x = 0; x < size_.width_px; ++x) {
      const DoubleIntegral::Pixel& pixel = pixels[x];
      const double log_mean = std::log(pixel.exp_integral / duration_us);
      const double mean = pixel.plain_integral / duration_us;
      const auto e_reference = static_cast<double>(pixel.e_reference);
      sharp.log_sharp(y, x) += static_cast<float>(c * e_reference - log_mean);
      sharp.mean_events(y, x) = static_cast<float>(mean - e_reference);
      sharp.events_since(y, x) = pixel.e - pixel.e_reference;
    }
  }
}

// To first order in c, log B = log I(f) + c (mean of E(f -> t)), so log B2 - log B1 = c (E(f1 -> f2) + the
// difference of the means).
void Deblur::estimate_contrast(const Sharp& now) {
  const cv::Mat1f log_change(now.log_blurred - sharp_.log_blurred);
  const cv::Mat1f event_change(sharp_.events_since - now.events_since + now.mean_events - sharp_.mean_events);
  const cv::Mat1b is_usable(now.is_usable & sharp_.is_usable);
  estimator_.add(log_change, event_change, is_usable);
  contrast_ = estimator_.contrast().value_or(kFirstContrast);
}

}  // namespace esi
