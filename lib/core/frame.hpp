#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "esi/core/time.hpp"

namespace esi {

/// A reconstructed image: it shows exactly the events with t < t_us.
struct Frame {
  std::int64_t index = 0;  ///< from 0, without gaps
  std::int64_t t_us = 0;
  std::int64_t events_since_previous = 0;
  cv::Mat1b grey;
};

/// An image that the camera itself took (an APS frame).
struct IntensityFrame {
  Interval exposure;  ///< empty (begin == end) where the recording gives only one time
  cv::Mat image;      ///< CV_8UC1, or CV_16UC1 that uses the full 16 bits
};

}  // namespace esi
