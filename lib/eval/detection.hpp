#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

namespace esi {

/// A tag that was decoded in an image. Pixel centres are at integers.
struct Detection {
  int id = 0;
  int hamming = 0;      ///< bits that were corrected
  double margin = 0.0;  ///< decision margin, grey levels
  cv::Point2d centre;
  /// x1, y1, ..., x4, y4 in px: lower left, lower right, upper right, upper left, as the tag is read.
  std::array<double, 8> xy_px{};

  friend bool operator==(const Detection&, const Detection&) = default;
};

/// What was found in one frame.
struct FrameDetections {
  std::int64_t index = 0;
  std::int64_t t_us = 0;
  std::vector<Detection> detections;
};

}  // namespace esi
