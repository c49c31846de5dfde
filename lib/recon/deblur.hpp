#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/contrast_estimator.hpp"
#include "esi/recon/double_integral.hpp"
#include "esi/recon/recent_events.hpp"

namespace esi {

/// Where within an exposure the sharp image stands.
enum class ReferenceTime { start, middle, end };

/// See docs/methods.md.
struct EdiOptions {
  std::optional<double> contrast;  ///< of the camera; nothing: estimated as the recording goes
  ReferenceTime reference = ReferenceTime::middle;

  void declare(OptionTable& table);
};

/// Makes every intensity frame sharp by the events of its exposure (Pan et al. 2019, Lin et al. 2023).
class Deblur {
 public:
  /// Longer exposures are refused: so far back events are kept.
  static constexpr std::int64_t kLongestExposure_us = 2'000'000;
  /// c before the recording has told one.
  static constexpr double kFirstContrast = 0.2;

  /// `method` is what messages call it. Throws an Error where memory doesn't suffice.
  Deblur(const EdiOptions& options, SensorSize size, std::string_view method);

  /// As Reconstructor::process.
  void take(std::span<const Event> events, std::span<const float> weights);
  /// Throws an Error where the frame isn't of the sensor's size, or longer than kLongestExposure_us.
  void observe(const IntensityFrame& frame);

  bool has_frame() const { return has_frame_; }
  double contrast() const { return contrast_; }
  /// log of the latest sharp image's share of white. Only after a frame.
  const cv::Mat1f& log_sharp() const { return sharp_.log_sharp; }
  /// Signed sum of each pixel's events since the time that log_sharp() shows.
  const cv::Mat1f& events_since() const { return sharp_.events_since; }

 private:
  /// A frame made sharp, with what comparing it with the next one takes.
  struct Sharp {
    cv::Mat1f log_blurred;
    cv::Mat1b is_usable;     ///< neither under- nor overexposed
    cv::Mat1f log_sharp;     ///< at the reference time f
    cv::Mat1f events_since;  ///< E(f -> now)
    cv::Mat1f mean_events;   ///< mean of E(f -> t) over the exposure
  };

  Sharp deblur(const cv::Mat1f& shares, Interval exposure);
  void integrate(Interval exposure, Sharp& sharp);
  /// Compares a frame with the one before.
  void estimate_contrast(const Sharp& now);

  EdiOptions options_;
  SensorSize size_;
  std::string_view method_;
  RecentEvents recent_;
  DoubleIntegral integral_;
  ContrastEstimator estimator_;
  double contrast_;
  bool has_frame_ = false;
  Sharp sharp_;  ///< the latest; before the first frame only its events_since is of account
};

}  // namespace esi
