#include "esi/sim/renderer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "esi/sim/board.hpp"
#include "esi/sim/ground.hpp"
#include "esi/sim/scenario.hpp"

using namespace esi;

namespace {

const Camera kCamera{CameraOptions{.sensor = "96x64"}};

/// A texture seen straight on from above at (x, y), one metre away; `texel_m` wide texels.
std::vector<float> seen(const Texture& texture, double texel_m, cv::Vec2d place, int y) {
  Surface surface;
  surface.texture = &texture;
  surface.along_u = {texel_m, 0, 0};
  surface.along_v = {0, texel_m, 0};
  const double side = texture.side();
  surface.origin = {-0.5 * side * texel_m + place[0], -0.5 * side * texel_m + place[1], 1.0};
  surface.corners = {cv::Vec2d(0, 0), {side, 0}, {side, side}, {0, side}};
  std::vector<float> row(static_cast<std::size_t>(kCamera.size.width_px));
  render_row(project({surface}, Pose{}, kCamera), y, row);
  return row;
}

Texture checkers(int log2_side, int square) {
  const int side = 1 << log2_side;
  std::vector<float> texels;
  for (int i = 0; i < side * side; ++i)
    texels.push_back((i % side / square + i / side / square) % 2 == 0 ? 0.1F : 0.9F);
  return {texels, log2_side};
}

Texture plain(float value) { return {std::vector<float>(64 * 64, value), 6}; }

}  // namespace

TEST_CASE("A pattern finer than pixels is an even grey, wherever it lies") {
  const Texture fine = checkers(10, 2);
  const double pixel_m = 1.0 / kCamera.focal_px;
  for (const double shift : {0.0, 0.13, 0.31, 0.5}) {
    for (const float light : seen(fine, pixel_m / 8.0, {shift * pixel_m, 0.0}, 32)) {
      if (light == 0.5F) continue;  // the texture covers the middle only; elsewhere is sky
      CHECK(light == Approx(0.5).margin(0.02));
    }
  }
}

TEST_CASE("A pattern coarser than pixels shows its own values in the middle of its squares") {
  const Texture coarse = checkers(7, 16);
  const double pixel_m = 1.0 / kCamera.focal_px;
  const auto row = seen(coarse, 0.5 * pixel_m, {0.0, 0.0}, 32);        // squares of 8 px
  const auto middle = static_cast<std::size_t>(kCamera.centre_px[0]);  // 47.5 is a corner of squares
  CHECK(std::abs(row[middle - 3] - row[middle + 4]) == Approx(0.8).margin(0.01));
  CHECK(std::abs(row[middle + 4] - row[middle + 12]) == Approx(0.8).margin(0.01));
}

TEST_CASE("A pixel that a border crosses gets the share that lies inside") {
  const Texture white = plain(1.0F);
  const double pixel_m = 1.0 / kCamera.focal_px;
  for (const double shift : {0.0, 0.25, 0.5, 0.8}) {
    // 20 px wide: the left border lies at 47.5 - 10 + shift.
    const auto row = seen(white, 20.0 * pixel_m / 64.0, {shift * pixel_m, 0.0}, 32);
    double sum = 0.0;
    for (const float light : row) sum += (light - 0.5) / 0.5;  // the sky is 0.5
    CHECK(sum == Approx(20.0).margin(1e-3));
    const double border = 37.5 + shift;
    const auto pixel = static_cast<std::size_t>(std::lround(border));
    const double inside = static_cast<double>(pixel) + 0.5 - border;
    CHECK((row[pixel] - 0.5) / 0.5 == Approx(inside).margin(1e-3));
  }
}

TEST_CASE("The light of a scene moves with the camera by fractions of a pixel, without jumps") {
  TrajectoryOptions slide;
  slide.kind = TrajectoryOptions::Kind::slide;
  slide.slide_mps = 0.1;  // 10 px/s at 2 m
  const Scenario scenario({}, slide, CameraOptions{.sensor = "96x64"}, 1);
  std::vector<float> before(96), after(96);
  render_row(scenario.view(0), 30, before);
  for (std::int64_t t_us = 1000; t_us <= 100'000; t_us += 1000) {
    render_row(scenario.view(t_us), 30, after);
    float largest = 0.0F;
    for (std::size_t x = 0; x < after.size(); ++x)
      largest = std::max(largest, std::abs(after[x] - before[x]));
    REQUIRE(largest < 0.01F);  // of 0.8 from black to white in a pixel or two, 0.003 px
    before.swap(after);
  }
}

TEST_CASE(
    "What lies in front covers what lies behind, and nothing shines through between the faces of a box") {
  Box box;
  box.half_m = {0.3, 0.3};
  box.height_m = 1.0;
  const Texture white = plain(1.0F), black = plain(0.0F);
  const Pose above{facing_down(0.4), {0.9, 0.7, 2.5}};
  std::vector<Surface> surfaces;
  Surface ground;
  ground.texture = &black;
  ground.along_u = {1.0, 0, 0};
  ground.along_v = {0, -1.0, 0};
  ground.corners = {cv::Vec2d(-20, -20), {20, -20}, {20, 20}, {-20, 20}};
  surfaces.push_back(ground);
  box.add_sides(above.position_m, white, 1, surfaces);
  REQUIRE(surfaces.size() == 3);
  surfaces.push_back(box.top(white, 5));
  for (Surface& surface : surfaces) surface.gain = 1.0F;
  const View view = project(surfaces, above, kCamera);
  std::vector<float> row(96);
  int covered = 0;
  for (int y = 0; y < 64; ++y) {
    render_row(view, y, row);
    // The outline is convex: along a row white begins and ends once, and there is nothing but white between.
    const auto is_white = [](float light) { return light > 0.99F; };
    const auto begin = std::find_if(row.begin(), row.end(), is_white);
    const auto end = std::find_if(row.rbegin(), row.rend(), is_white).base();
    if (begin == row.end()) continue;
    covered += static_cast<int>(end - begin);
    CHECK(std::all_of(begin, end, is_white));
    CHECK(std::count_if(row.begin(), begin, [](float light) { return light > 0.01F; }) <= 4);
  }
  CHECK(covered > 200);
}

TEST_CASE("The amplitude of the ground's spectrum falls as 1/f") {
  const Texture ground = ground_texture(0.25, 0.35, 4);
  const int side = ground.side();
  const Texture::Level level = ground.level(0);
  cv::Mat1f log_light(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      log_light(y, x) = std::log(static_cast<float>(level.texels[y * level.stride() + x]) / Texture::kOne);
    }
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(log_light, mean, deviation);
  CHECK(mean[0] == Approx(std::log(0.25)).margin(0.03));
  CHECK(deviation[0] == Approx(0.35).epsilon(0.03));
  cv::Mat2f spectrum;
  cv::dft(log_light - mean[0], spectrum, cv::DFT_COMPLEX_OUTPUT);
  // Mean power per octave, from 4 to 512 periods of 2048 texels.
  std::vector<double> power(7, 0.0), count(7, 0.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double frequency = std::hypot(x < side / 2 ? x : x - side, y < side / 2 ? y : y - side);
      if (frequency < 4 || frequency >= 512) continue;
      const auto octave = static_cast<std::size_t>(std::log2(frequency / 4.0));
      power[octave] += spectrum(y, x).dot(spectrum(y, x));
      count[octave] += 1.0;
    }
  }
  for (std::size_t i = 1; i < power.size(); ++i) {
    const double slope = 0.5 * std::log2((power[i] / count[i]) / (power[i - 1] / count[i - 1]));
    INFO("octave " << i);
    CHECK(slope == Approx(-1.0).margin(0.3));
  }
}
