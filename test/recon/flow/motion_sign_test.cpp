#include "esi/recon/flow/motion_sign.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "recon/flow/textures.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const cv::Size kHalf{80, 64};
constexpr double kCell_px = 8.0;       ///< of the half resolution
const cv::Point2d kMotion(0.4, -0.3);  ///< of the full resolution, in a window

/// b = -v . grad L of window k, at half resolution, of a texture that moves by kMotion times `speed`.
cv::Mat1f events_of_window(int k, double speed = 1.0) {
  static const Waves waves(5, 8.0, 30.0);
  const cv::Point2d v = 0.5 * speed * kMotion;
  const cv::Point2d before = static_cast<double>(k) * v;
  return image_of(kHalf, [&](int x, int y) {
    const cv::Point2d place(x, y);
    return waves.at(place - before - v) - waves.at(place - before);
  });
}

/// The texture's motion, times `factor` of the cell's column.
MotionField motion(const CellGrid& cells, const std::function<float(int column)>& factor) {
  MotionField field{cv::Mat1f(cells.size()), cv::Mat1f(cells.size())};
  for (int y = 0; y < field.x.rows; ++y) {
    for (int x = 0; x < field.x.cols; ++x) {
      field.x(y, x) = factor(x) * static_cast<float>(kMotion.x);
      field.y(y, x) = factor(x) * static_cast<float>(kMotion.y);
    }
  }
  return field;
}

/// Of windows [begin, end).
void take_windows(MotionSign& sign, const MotionField& field, int begin, int end, double speed = 1.0) {
  for (int k = begin; k < end; ++k) sign.take(events_of_window(k, speed), field);
}

const CellGrid kCells(kHalf, kCell_px);

}  // namespace

TEST_CASE("events tell a slow motion from its opposite, where each is taken for the image's") {
  MotionSign right(kHalf, kCells);
  const MotionField as_it_is = motion(kCells, [](int) { return 1.0F; });
  take_windows(right, as_it_is, 0, 20);
  CHECK(right.signs(as_it_is).empty());

  MotionSign wrong(kHalf, kCells);
  const MotionField reversed = motion(kCells, [](int) { return -1.0F; });
  take_windows(wrong, reversed, 0, 20);
  const cv::Mat1f signs = wrong.signs(reversed);
  REQUIRE(signs.size() == kCells.size());
  CHECK(cv::countNonZero(signs == -1.0F) == static_cast<int>(signs.total()));
}

TEST_CASE("one window says nothing about the sign") {
  MotionSign sign(kHalf, kCells);
  const MotionField reversed = motion(kCells, [](int) { return -1.0F; });
  take_windows(sign, reversed, 0, 1);
  CHECK(sign.signs(reversed).empty());
}

TEST_CASE("only the part that has the opposite motion is turned") {
  MotionSign sign(kHalf, kCells);
  const MotionField mixed = motion(kCells, [](int column) { return column < 5 ? -1.0F : 1.0F; });
  take_windows(sign, mixed, 0, 20);
  const cv::Mat1f signs = sign.signs(mixed);
  REQUIRE(!signs.empty());
  for (int y = 0; y < signs.rows; ++y) {
    CHECK(signs(y, 1) == -1.0F);
    CHECK(signs(y, 8) == 1.0F);
  }
}

TEST_CASE("what moves by a pixel in a window isn't turned: it shows its direction") {
  MotionSign sign(kHalf, kCells);
  const MotionField reversed = motion(kCells, [](int) { return -2.5F; });
  take_windows(sign, reversed, 0, 20, 2.5);
  CHECK(sign.signs(reversed).empty());
  // The same piles at a slower speed are opposite.
  CHECK_FALSE(sign.signs(motion(kCells, [](int) { return -1.0F; })).empty());
}

TEST_CASE("once turned, a motion is right, and stays so") {
  MotionSign sign(kHalf, kCells);
  const MotionField reversed = motion(kCells, [](int) { return -1.0F; });
  take_windows(sign, reversed, 0, 20);
  sign.turn(sign.signs(reversed));
  const MotionField right = motion(kCells, [](int) { return 1.0F; });
  take_windows(sign, right, 20, 21);
  CHECK(sign.signs(right).empty());
  take_windows(sign, right, 21, 40);
  CHECK(sign.signs(right).empty());
}

TEST_CASE("without events there is no opposite") {
  MotionSign sign(kHalf, kCells);
  const MotionField still = motion(kCells, [](int) { return 0.0F; });
  for (int k = 0; k < 5; ++k) sign.take(cv::Mat1f(kHalf, 0.0F), still);
  CHECK(sign.signs(still).empty());
}
