#include "esi/sim/board.hpp"

#include <algorithm>
#include <cmath>

#include "esi/sim/tag_image.hpp"

namespace esi {
namespace {

constexpr int kLog2Side = 10;
constexpr int kSide = 1 << kLog2Side;
static_assert(kSide * kBoardTexel_m == kDeckSide_m);

constexpr float kDeck = 0.10F;
constexpr float kWhite = 0.85F;  ///< paper
constexpr float kBlack = 0.05F;  ///< toner

int texels(double length_m) { return static_cast<int>(std::lround(length_m / kBoardTexel_m)); }

/// A white or black square with its upper left corner at (x, y).
void paint(std::vector<float>& image, int x, int y, int side, float reflectance) {
  for (int row = y; row < y + side; ++row) {
    std::fill_n(image.begin() + static_cast<std::ptrdiff_t>(row) * kSide + x, side, reflectance);
  }
}

void paint(std::vector<float>& image, const BoardTag& board_tag) {
  const TagImage tag = tag36h11_image(board_tag.id);
  const int cell = texels(board_tag.size_m / tag.border_cells);
  const int half = cell * tag.side_cells / 2;
  const int left = kSide / 2 + texels(board_tag.centre_m[0]) - half;
  const int top = kSide / 2 + texels(board_tag.centre_m[1]) - half;
  for (int row = 0; row < tag.side_cells; ++row) {
    for (int column = 0; column < tag.side_cells; ++column) {
      paint(image, left + column * cell, top + row * cell, cell, tag.white(row, column) ? kWhite : kBlack);
    }
  }
}

}  // namespace

const std::vector<BoardTag>& board_tags() {
  static const std::vector<BoardTag> tags{{0, 0.36, {-0.0675, 0.0}}, {1, 0.10, {0.23, 0.0}}};
  return tags;
}

Texture board_texture() {
  std::vector<float> image(static_cast<std::size_t>(kSide) * kSide, kDeck);
  const int board = texels(kBoardSide_m);
  paint(image, (kSide - board) / 2, (kSide - board) / 2, board, kWhite);
  for (const BoardTag& tag : board_tags()) paint(image, tag);
  return {image, kLog2Side};
}

}  // namespace esi
