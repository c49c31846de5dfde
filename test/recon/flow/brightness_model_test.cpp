#include "esi/recon/flow/brightness_model.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "recon/flow/random_problems.hpp"
#include "recon/flow/textures.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const cv::Size kImage{40, 30};

MotionField constant(const CellGrid& cells, float x, float y) {
  return {cv::Mat1f(cells.size(), x), cv::Mat1f(cells.size(), y)};
}

}  // namespace

TEST_CASE("A sums v v^T and forgets by the path and by the memory") {
  BrightnessModel model(kImage, {.eps = 0.02F, .mu = 0.001F, .memory = 0.9, .memory_px = 2.0F});
  CellGrid cells(kImage, 16.0);
  const cv::Mat1f nothing(kImage, 0.0F);
  // Of 20 ms.
  model.take(nothing, 2.0, constant(cells, 3.0F, 4.0F), cells);
  const MotionOperator& m = model.normal_operator();
  // v = (3, 4): D = 3.5, E = -0.5 of L = v . x / ... : dd = ((3 + 4) / 2)^2
  CHECK(m.dd(7, 9) == Approx(0.5 * 3.5 * 3.5));
  CHECK(m.de(7, 9) == Approx(0.5 * 3.5 * -0.5));
  CHECK(m.ee(7, 9) == Approx(0.5 * 0.5 * 0.5));
  model.take(nothing, 2.0, constant(cells, 3.0F, 4.0F), cells);
  CHECK(m.dd(7, 9) == Approx(0.5 * 3.5 * 3.5 * (1.0 + 0.81 / (1.0 + 5.0 / 2.0))));
  // Of 5 ms, and without motion: half of 10 ms is forgotten.
  model.take(nothing, 0.5, constant(cells, 0.0F, 0.0F), cells);
  CHECK(m.dd(7, 9) == Approx(std::sqrt(0.9) * 0.5 * 3.5 * 3.5 * (1.0 + 0.81 / (1.0 + 5.0 / 2.0))));
  CHECK(m.dd(7, kImage.width - 1) == 0.0F);
  CHECK(m.dd(kImage.height - 1, 9) == 0.0F);
}

TEST_CASE("the right-hand side is that of the energy, for the events of a moving ramp") {
  // L = x + 2 y moves by v: b = -v . grad L everywhere, and L itself solves the problem without eps and mu.
  BrightnessModel model(kImage, {.eps = 0.0F, .mu = 0.0F, .memory = 0.9, .memory_px = 2.0F});
  CellGrid cells(kImage, 16.0);
  for (const cv::Point2f v : {cv::Point2f(1.0F, 0.5F), cv::Point2f(-0.5F, 1.0F), cv::Point2f(0.3F, 0.3F)}) {
    model.take(cv::Mat1f(kImage, -(v.x + 2.0F * v.y)), 1.0, constant(cells, v.x, v.y), cells);
  }
  cv::Mat1f rhs, product;
  model.right_hand_side(rhs);
  const cv::Mat1f ramp = image_of(kImage, [](int x, int y) { return x + 2.0 * y; });
  model.normal_operator().apply(ramp, product);
  CHECK(cv::norm(rhs) > 1.0);
  CHECK(cv::norm(rhs, product, cv::NORM_INF) < 1e-3);
}

TEST_CASE("an image of one row or column has no corners, and no right-hand side") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 20), cv::Size(20, 1)}) {
    BrightnessModel model(size, {.eps = 0.02F, .mu = 0.001F, .memory = 1.0, .memory_px = 2.0F});
    CellGrid cells(size, 16.0);
    model.take(random_image(size, 4), 1.0, constant(cells, 0.7F, -0.4F), cells);
    cv::Mat1f rhs(size, 1.0F);
    model.right_hand_side(rhs);
    CHECK(cv::norm(rhs) == 0.0);
  }
}

TEST_CASE("the image and a move with the motion") {
  BrightnessModel model(kImage, {.eps = 0.02F, .mu = 0.001F, .memory = 1.0, .memory_px = 1e6F});
  CellGrid cells(kImage, 16.0);
  const Waves waves(2, 8.0, 30.0);
  const auto image_at = [&](double dx, double dy) {
    return image_of(kImage, [&](int x, int y) { return waves.at(x - dx, y - dy); });
  };
  model.log_intensity() = image_at(0, 0);
  const cv::Mat1f b = random_image(kImage, 9);
  model.take(b, 1.0, constant(cells, 1.0F, 0.0F), cells);
  CHECK(correlation(model.log_intensity(), image_at(1, 0), 4) > 0.9999);
  cv::Mat1f before, after;
  model.right_hand_side(before);
  model.take(cv::Mat1f(kImage, 0.0F), 1.0, constant(cells, 0.0F, 3.0F), cells);
  model.right_hand_side(after);
  const cv::Rect inner(4, 4, 30, 20);
  CHECK(cv::norm(after(inner + cv::Point(0, 3)), before(inner), cv::NORM_INF) < 1e-3);
  CHECK(correlation(model.log_intensity(), image_at(1, 3), 5) > 0.9999);
}

TEST_CASE("events are taken from half way back") {
  BrightnessModel model(kImage, {.eps = 0.02F, .mu = 0.001F, .memory = 1.0, .memory_px = 2.0F});
  CellGrid cells(kImage, 16.0);
  cv::Mat1f b(kImage, 0.0F);
  b(15, 20) = 1.0F;
  model.take(b, 1.0, constant(cells, 3.0F, 0.0F), cells);
  cv::Mat1f rhs;
  model.right_hand_side(rhs);
  // Corners (21, 14) and (21, 15), at (21.5, 14.5) and (21.5, 15.5), look up (20, 14.5) and (20, 15.5).
  cv::Mat1f expected(kImage, 0.0F);
  for (const int y : {14, 15}) {
    for (const int dy : {0, 1}) {
      expected(y + dy, 21) += 0.5F * 0.5F * 3.0F;
      expected(y + dy, 22) -= 0.5F * 0.5F * 3.0F;
    }
  }
  CHECK(cv::norm(rhs, expected, cv::NORM_INF) < 1e-5);
}

TEST_CASE("what turns out to be a negative changes its sign, with what the windows so far said of it") {
  BrightnessModel model(kImage, {.eps = 0.02F, .mu = 0.001F, .memory = 1.0, .memory_px = 2.0F});
  CellGrid cells(kImage, 10.0);
  model.take(random_image(kImage, 4), 1.0, constant(cells, 0.7F, -0.4F), cells);
  random_image(kImage, 5).copyTo(model.log_intensity());
  cv::Mat1f rhs, turned_rhs;
  model.right_hand_side(rhs);
  const cv::Mat1f image = model.log_intensity().clone();
  const cv::Mat1f dd = model.normal_operator().dd.clone();
  cv::Mat1f signs(cells.size(), 1.0F);
  signs.colRange(0, 2).setTo(-1.0F);
  model.turn(signs, cells);
  model.right_hand_side(turned_rhs);
  CHECK(cv::norm(model.normal_operator().dd, dd, cv::NORM_INF) == 0.0);
  // Up to the middle of the second cell; halfway to the third it goes through 0.
  const cv::Rect left(0, 0, 15, kImage.height);
  const cv::Rect right(26, 0, kImage.width - 26, kImage.height);
  CHECK(cv::norm(model.log_intensity()(left), -image(left), cv::NORM_INF) == 0.0);
  CHECK(cv::norm(model.log_intensity()(right), image(right), cv::NORM_INF) == 0.0);
  CHECK(std::abs(model.log_intensity()(4, 19)) < 0.15 * std::abs(image(4, 19)));
  CHECK(cv::norm(turned_rhs(left & cv::Rect(0, 0, 14, kImage.height)),
                 -rhs(left & cv::Rect(0, 0, 14, kImage.height)), cv::NORM_INF) == 0.0);
  CHECK(cv::norm(turned_rhs(right), rhs(right), cv::NORM_INF) == 0.0);
}
