#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "esi/sim/texture.hpp"

namespace esi {

/// A tag on the board. The board's frame has its origin in the middle; as the tags are read, x is right and y
/// down, in metres.
struct BoardTag {
  std::int64_t id = 0;
  double size_m = 0.0;  ///< side of the black border
  cv::Vec2d centre_m;
};

inline constexpr double kBoardSide_m = 0.6;
/// The board lies on a dark deck that shows this far around it.
inline constexpr double kDeckSide_m = 0.64;
/// Every edge on the board lies between two texels.
inline constexpr double kBoardTexel_m = 0.000625;

/// A large tag, and beside it a small one for the last metre.
const std::vector<BoardTag>& board_tags();

/// Reflectance of the deck with the board on it, kDeckSide_m a side.
Texture board_texture();

}  // namespace esi
