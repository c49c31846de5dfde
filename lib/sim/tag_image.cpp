#include "esi/sim/tag_image.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <fmt/format.h>

#include <memory>

#include "esi/core/error.hpp"

namespace esi {

TagImage tag36h11_image(std::int64_t id) {
  const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                               &tag36h11_destroy);
  if (id < 0 || id >= static_cast<std::int64_t>(family->ncodes)) {
    throw usage_error(fmt::format("tag {}: {} has the ids 0 to {}", id, kTagFamily, family->ncodes - 1));
  }
  const std::unique_ptr<image_u8_t, decltype(&image_u8_destroy)> drawn(
      apriltag_to_image(family.get(), static_cast<int>(id)), &image_u8_destroy);
  TagImage tag{drawn->width, family->width_at_border, {}};
  for (int row = 0; row < drawn->height; ++row) {
    for (int column = 0; column < drawn->width; ++column) {
      tag.is_white.push_back(drawn->buf[row * drawn->stride + column] > 127);
    }
  }
  return tag;
}

}  // namespace esi
