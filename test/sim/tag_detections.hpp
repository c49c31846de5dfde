#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <array>
#include <map>
#include <opencv2/core/mat.hpp>

namespace esi::test {

/// What the AprilTag library sees: corners by id, in px with pixel centres at integers.
inline std::map<int, std::array<cv::Vec2d, 4>> detect_tags(const cv::Mat1b& grey) {
  apriltag_family_t* const family = tag36h11_create();
  apriltag_detector_t* const detector = apriltag_detector_create();
  apriltag_detector_add_family_bits(detector, family, 1);
  detector->quad_decimate = 1.0F;
  image_u8_t image{grey.cols, grey.rows, static_cast<int>(grey.step), grey.data};
  zarray_t* const found = apriltag_detector_detect(detector, &image);
  std::map<int, std::array<cv::Vec2d, 4>> tags;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found, i, static_cast<void*>(&detection));
    for (std::size_t k = 0; k < 4; ++k) {  // AprilTag's pixel centres are at +0.5
      tags[detection->id][k] = cv::Vec2d(detection->p[k][0] - 0.5, detection->p[k][1] - 0.5);
    }
  }
  apriltag_detections_destroy(found);
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
  return tags;
}

}  // namespace esi::test
