#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"

namespace esi {

/// The events of a window as an image: b(x) = sum of w p over pixel x's events, where
///   w_on = sqrt(N_off / N_on),  w_off = 1 / w_on                                                (1)
/// makes up for thresholds that differ. N count all events of the windows before this one.
class EventImage {
 public:
  EventImage(SensorSize size, bool balance);

  /// `weights` are empty (all 1) or one a piece.
  const cv::Mat1f& of(std::span<const Event> window, std::span<const float> weights);

 private:
  void count(std::span<const Event> window);

  bool balance_;
  cv::Mat1f image_;
  double on_ = 0.0, off_ = 0.0;
};

}  // namespace esi
