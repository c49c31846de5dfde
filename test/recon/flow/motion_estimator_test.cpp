#include "esi/recon/flow/motion_estimator.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "esi/recon/flow/half_size.hpp"
#include "recon/flow/textures.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const cv::Size kFull{160, 128};
constexpr double kCell_px = 16.0;

/// px a window, at a place of the full resolution.
using Motion = std::function<cv::Point2d(cv::Point2d)>;

cv::Point2d in_full(int x, int y) { return {2.0 * x + 0.5, 2.0 * y + 0.5}; }

/// The estimate from two images of half resolution, the second of which shows at x what the first shows at
/// x - windows v(x).
MotionField estimate(const Motion& motion, float windows, int calls) {
  const Waves waves(3, 16.0, 60.0);
  const cv::Size half = half_of(kFull);
  const cv::Mat1f before = image_of(half, [&](int x, int y) { return waves.at(in_full(x, y)); });
  const cv::Mat1f after = image_of(half, [&](int x, int y) {
    const cv::Point2d place = in_full(x, y);
    return waves.at(place - static_cast<double>(windows) * motion(place));
  });
  MotionEstimator estimator(kFull, {.cell_px = kCell_px, .regularisation = 0.01, .hold = 0.0, .rounds = 2});
  MotionField field{cv::Mat1f(estimator.cells().size(), 0.0F), cv::Mat1f(estimator.cells().size(), 0.0F)};
  for (int i = 0; i < calls; ++i) {
    const MovedPair pair{before, after, 1.0F, windows};
    estimator.improve({&pair, 1}, field);
  }
  return field;
}

/// Largest error over the cells away from the border, as far as the smoothing of cells carries what comes in
/// there; in px a window.
double worst_error(const MotionField& field, const Motion& motion) {
  double worst = 0.0;
  for (int y = 2; y + 2 < field.x.rows; ++y) {
    for (int x = 2; x + 2 < field.x.cols; ++x) {
      const cv::Point2d centre((x + 0.5) * kCell_px - 0.5, (y + 0.5) * kCell_px - 0.5);
      const cv::Point2d shown(field.x(y, x), field.y(y, x));
      worst = std::max(worst, cv::norm(shown - motion(centre)));
    }
  }
  return worst;
}

const cv::Point2d kMiddle(79.5, 63.5);

}  // namespace

TEST_CASE("flow on translated textures is within 0.1 px") {
  for (const cv::Point2d v : {cv::Point2d(0, 0), cv::Point2d(0.3, -0.2), cv::Point2d(1.5, 1.0),
                              cv::Point2d(-2.5, 0.5), cv::Point2d(0.0, 3.0)}) {
    INFO(v.x << " " << v.y);
    const Motion motion = [v](cv::Point2d) { return v; };
    CHECK(worst_error(estimate(motion, 1.0F, 4), motion) < 0.1);
  }
}

TEST_CASE("flow on rotated textures is within 0.1 px") {
  for (const double turn : {0.02, -0.03}) {
    const Motion motion = [turn](cv::Point2d at) {
      return cv::Point2d(-turn * (at.y - kMiddle.y), turn * (at.x - kMiddle.x));
    };
    CHECK(worst_error(estimate(motion, 1.0F, 12), motion) < 0.1);
  }
}

TEST_CASE("flow on zoomed textures is within 0.1 px") {
  for (const double zoom : {0.03, -0.02}) {
    const Motion motion = [zoom](cv::Point2d at) { return zoom * (at - kMiddle); };
    CHECK(worst_error(estimate(motion, 1.0F, 12), motion) < 0.1);
  }
}

TEST_CASE("a pair that is several windows apart gives the motion of one") {
  const cv::Point2d v(0.6, -0.4);
  const Motion motion = [v](cv::Point2d) { return v; };
  CHECK(worst_error(estimate(motion, 4.0F, 4), motion) < 0.1);
}

TEST_CASE("pairs of different distances go together, in any order") {
  const cv::Point2d v(0.6, -0.4);
  const Waves waves(3, 16.0, 60.0);
  const auto image_after = [&](double windows) {
    return image_of(half_of(kFull), [&](int x, int y) { return waves.at(in_full(x, y) - windows * v); });
  };
  const cv::Mat1f before = image_after(0.0);
  const cv::Mat1f after = image_after(1.0);
  const cv::Mat1f later = image_after(3.0);
  const MovedPair near{before, after, 1.0F, 1.0F};
  const MovedPair far{before, later, 1.0F, 3.0F};
  for (const auto& pairs : {std::array{near, far, near}, std::array{far, near, far}}) {
    MotionEstimator estimator(kFull, {.cell_px = kCell_px, .regularisation = 0.01, .hold = 0.0, .rounds = 2});
    MotionField field{cv::Mat1f(estimator.cells().size(), 0.0F), cv::Mat1f(estimator.cells().size(), 0.0F)};
    for (int i = 0; i < 4; ++i) estimator.improve(pairs, field);
    CHECK(worst_error(field, [v](cv::Point2d) { return v; }) < 0.05);
  }
}

TEST_CASE("pairs count by their weights, and without texture the motion is the neighbours'") {
  const Waves waves(3, 16.0, 60.0);
  const cv::Size half = half_of(kFull);
  const cv::Point2d one(0.8, 0.0);
  const cv::Point2d other(0.0, 0.8);
  const auto image = [&](cv::Point2d moved) {
    return image_of(half, [&](int x, int y) {
      // Flat on the right half of the image.
      const cv::Point2d place = in_full(x, y) - moved;
      return waves.at(place) / (1.0 + std::exp(0.3 * (place.x - 70.0)));
    });
  };
  const cv::Mat1f before = image({0, 0});
  const cv::Mat1f after_one = image(one);
  const cv::Mat1f after_other = image(other);
  MotionEstimator estimator(kFull, {.cell_px = kCell_px, .regularisation = 0.01, .hold = 0.0, .rounds = 2});
  const auto mean_of = [&](float weight_one, float weight_other) {
    MotionField field{cv::Mat1f(estimator.cells().size(), 0.0F), cv::Mat1f(estimator.cells().size(), 0.0F)};
    const std::array pairs{MovedPair{before, after_one, weight_one, 1.0F},
                           MovedPair{before, after_other, weight_other, 1.0F}};
    for (int i = 0; i < 200; ++i) estimator.improve(pairs, field);
    CHECK(field.x(4, 8) == Approx(field.x(4, 6)).margin(0.2));  // carried over into the flat part
    CHECK(field.y(4, 8) == Approx(field.y(4, 6)).margin(0.2));
    return cv::Point2d(field.x(4, 2), field.y(4, 2));
  };
  CHECK(cv::norm(mean_of(1.0F, 0.0F) - one) < 0.1);
  CHECK(cv::norm(mean_of(0.0F, 1.0F) - other) < 0.1);
  CHECK(cv::norm(mean_of(100.0F, 1.0F) - one) < 0.15);
}

TEST_CASE("images of any size have a motion, and flat ones have none") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 40), cv::Size(33, 2), cv::Size(17, 35)}) {
    MotionEstimator estimator(size, {.cell_px = kCell_px, .regularisation = 0.1, .hold = 0.0, .rounds = 2});
    const cv::Mat1f flat(half_of(size), 1.0F);
    MotionField field{cv::Mat1f(estimator.cells().size(), 0.0F), cv::Mat1f(estimator.cells().size(), 0.0F)};
    const MovedPair pair{flat, flat, 1.0F, 1.0F};
    estimator.improve({&pair, 1}, field);
    CHECK(cv::norm(field.x) + cv::norm(field.y) == 0.0);
  }
}

TEST_CASE("a pair corrects the speed of the whole field, and nothing else of it") {
  const cv::Point2d v(0.8, -0.5);
  const Waves waves(3, 16.0, 60.0);
  const cv::Size half = half_of(kFull);
  const cv::Mat1f before = image_of(half, [&](int x, int y) { return waves.at(in_full(x, y)); });
  const cv::Mat1f after = image_of(half, [&](int x, int y) { return waves.at(in_full(x, y) - v); });
  const MovedPair pair{before, after, 5.0F, 1.0F};
  MotionEstimator estimator(kFull, {.cell_px = kCell_px, .regularisation = 0.01, .hold = 0.0, .rounds = 2});
  const auto corrected = [&](double speed, int calls) {
    const auto x = static_cast<float>(speed * v.x);
    const auto y = static_cast<float>(speed * v.y);
    MotionField field{cv::Mat1f(estimator.cells().size(), x), cv::Mat1f(estimator.cells().size(), y)};
    for (int i = 0; i < calls; ++i) estimator.correct_speed(pair, field);
    CHECK(field.y(2, 3) == Approx(field.x(2, 3) * v.y / v.x));
    CHECK(field.x(2, 3) == field.x(5, 1));
    return static_cast<double>(field.x(2, 3)) / v.x;
  };
  for (const double speed : {0.9, 1.1, 1.2}) {
    INFO(speed);
    CHECK(corrected(speed, 1) == Approx(0.5 * (speed + 1.0)).margin(0.02));
    CHECK(corrected(speed, 10) == Approx(1.0).margin(0.02));
  }
  // Not by more than a fifth or a quarter in one window.
  CHECK(corrected(3.0, 1) == Approx(2.4));
  CHECK(corrected(0.1, 1) == Approx(0.125));
}

TEST_CASE("what all cells share is taken at once, what is a cell's own is held") {
  // The left half is faster.
  const Motion motion = [](cv::Point2d at) { return cv::Point2d(at.x < 80.0 ? 1.0 : 0.5, 0.0); };
  const auto spread_after_one = [&](double hold) {
    const Waves waves(3, 16.0, 60.0);
    const cv::Size half = half_of(kFull);
    const cv::Mat1f before = image_of(half, [&](int x, int y) { return waves.at(in_full(x, y)); });
    const cv::Mat1f after = image_of(half, [&](int x, int y) {
      const cv::Point2d place = in_full(x, y);
      return waves.at(place - motion(place));
    });
    MotionEstimator estimator(kFull,
                              {.cell_px = kCell_px, .regularisation = 0.01, .hold = hold, .rounds = 1});
    MotionField field{cv::Mat1f(estimator.cells().size(), 0.0F), cv::Mat1f(estimator.cells().size(), 0.0F)};
    const MovedPair pair{before, after, 1.0F, 1.0F};
    estimator.improve({&pair, 1}, field);
    CHECK(cv::mean(field.x)[0] == Approx(0.75).margin(0.05));
    return static_cast<double>(field.x(4, 4) - field.x(4, 5));
  };
  const double free = spread_after_one(0.0);
  const double held = spread_after_one(100.0);
  INFO(free << " " << held);
  CHECK(free > 1.3 * held);
  CHECK(held > 0.0);
}
