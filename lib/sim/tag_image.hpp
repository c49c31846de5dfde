#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace esi {

/// A printed AprilTag, one entry per square cell, row by row from the top left: its black border, what is in
/// it, and the white margin around it.
struct TagImage {
  int side_cells = 0;
  int border_cells = 0;  ///< side of the black border, whose corners are the tag's corners
  std::vector<bool> is_white;

  bool white(int row, int column) const {
    return is_white[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_cells) +
                    static_cast<std::size_t>(column)];
  }
};

/// The family that the simulator's boards carry.
inline constexpr const char* kTagFamily = "tag36h11";

/// Drawn by the AprilTag library itself. Throws a usage Error for ids that the family doesn't have.
TagImage tag36h11_image(std::int64_t id);

}  // namespace esi
