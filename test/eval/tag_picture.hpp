#pragma once

#include <apriltag/apriltag.h>

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "esi/eval/tag_families.hpp"

namespace esi::test {

struct TagPicture {
  cv::Mat1b grey;
  std::array<double, 8> corners_px{};  ///< lower left, lower right, upper right, upper left
};

/// A tag drawn by the AprilTag library on grey, each cell of so many pixels; `at` is where its image begins.
inline TagPicture tag_picture(const std::string& family, int id, int cell_px, cv::Size size = {200, 200},
                              cv::Point at = {40, 30}) {
  const TagFamily tags = make_tag_family(family);
  image_u8_t* const cells = apriltag_to_image(tags.get(), id);
  TagPicture picture{cv::Mat1b(size, 200), {}};
  for (int y = 0; y < cells->height * cell_px; ++y) {
    for (int x = 0; x < cells->width * cell_px; ++x) {
      picture.grey(at.y + y, at.x + x) = cells->buf[y / cell_px * cells->stride + x / cell_px];
    }
  }
  image_u8_destroy(cells);
  const int margin = (tags->total_width - tags->width_at_border) / 2;
  const double left = at.x + cell_px * margin - 0.5, top = at.y + cell_px * margin - 0.5;
  const double right = left + cell_px * tags->width_at_border, bottom = top + cell_px * tags->width_at_border;
  picture.corners_px = {left, bottom, right, bottom, right, top, left, top};
  return picture;
}

}  // namespace esi::test
