#include "esi/recon/flow/multilevel_solver.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "esi/recon/flow/brightness_model.hpp"
#include "recon/flow/flow_configs.hpp"
#include "recon/flow/least_squares_reference.hpp"
#include "recon/flow/random_problems.hpp"
#include "recon/flow/textures.hpp"

using namespace esi;
using namespace esi::test;

namespace {

/// As after `windows` of a texture that moves along a slow curve, each solved with `options`; the camera sees
/// all that the model assumes.
struct MovedTexture {
  MovedTexture(const EsiFlowOptions& options, int windows)
      : model(kSize, options.model()), solver(kSize, options.solver()) {
    const Waves waves(5, 6.0, 60.0);
    CellGrid cells(kSize, 16.0);
    cv::Point2d at(0.0, 0.0);
    for (int k = 0; k < windows; ++k) {
      const double angle = 0.15 * k;
      const cv::Point2d v(1.3 * std::cos(angle), 1.3 * std::sin(angle));
      const cv::Mat1f b = image_of(kSize, [&](int x, int y) {
        return waves.at(cv::Point2d(x, y) - at - v) - waves.at(cv::Point2d(x, y) - at);
      });
      const MotionField field{cv::Mat1f(cells.size(), static_cast<float>(v.x)),
                              cv::Mat1f(cells.size(), static_cast<float>(v.y))};
      model.take(b, 1.0, field, cells);
      model.right_hand_side(rhs);
      solver.solve(model.normal_operator(), rhs, static_cast<int>(options.cycles), model.log_intensity());
      at += v;
    }
    truth = image_of(kSize, [&](int x, int y) { return waves.at(cv::Point2d(x, y) - at); });
  }

  inline static const cv::Size kSize{120, 90};
  BrightnessModel model;
  MultilevelSolver solver;
  cv::Mat1f rhs, truth;
};

}  // namespace

TEST_CASE("with the quality config the solution leaves a thousandth of the residual") {
  MovedTexture moved(flow_options_of("esi-flow-quality"), 20);
  const LeastSquaresReference reference(moved.model.normal_operator());
  CHECK(reference.relative_residual(moved.model.log_intensity(), moved.rhs) <= 1e-3);
}

TEST_CASE("with each config the solution is near the exact one, and that near the truth") {
  for (const char* const config : {"esi-flow", "esi-flow-fast", "esi-flow-quality"}) {
    INFO(config);
    MovedTexture moved(flow_options_of(config), 20);
    const LeastSquaresReference reference(moved.model.normal_operator());
    cv::Mat1d rhs;
    moved.rhs.convertTo(rhs, CV_64F);
    cv::Mat1f exact;
    reference.solve(rhs).convertTo(exact, CV_32F);
    CHECK(correlation(moved.model.log_intensity(), exact) > 0.95);
    CHECK(correlation(exact, moved.truth, 16) > 0.9);
  }
}

TEST_CASE("more cycles come nearer to the solution, from any start, on random A") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 3), cv::Size(9, 1), cv::Size(61, 47)}) {
    INFO(size.width << "x" << size.height);
    MotionOperator normal = random_operator(size, 21);
    const LeastSquaresReference reference(normal);
    const cv::Mat1f rhs = random_image(size, 22);
    const cv::Mat1f start = random_image(size, 23);
    cv::Mat1d exact_rhs;
    rhs.convertTo(exact_rhs, CV_64F);
    cv::Mat1f exact;
    reference.solve(exact_rhs).convertTo(exact, CV_32F);
    const double rounding = reference.relative_residual(exact, rhs);
    double before = 1e30;
    for (const int cycles : {1, 4, 16}) {
      MultilevelSolver solver(size, {{4, 8, 16}});
      cv::Mat1f solution = start.clone();
      solver.solve(normal, rhs, cycles, solution);
      const double residual = reference.relative_residual(solution, rhs);
      CHECK(residual < std::max(0.5 * before, 2.0 * rounding));
      before = residual;
    }
    CHECK(before < 0.03);
  }
}

TEST_CASE("coarse levels bring what steps at full resolution alone don't") {
  // One long wave, which A of motion along both axes must be solved for from far away.
  const cv::Size size(128, 96);
  MotionOperator normal(size);
  normal.eps = 0.02F;
  normal.mu = 1e-5F;
  for (cv::Mat1f* const a : {&normal.dd, &normal.ee}) {
    (*a)(cv::Rect(0, 0, size.width - 1, size.height - 1)).setTo(1.0F);
  }
  const cv::Mat1f wave = image_of(size, [](int x, int y) { return std::sin(0.05 * x + 0.04 * y); });
  cv::Mat1f rhs;
  normal.apply(wave, rhs);
  const auto error_with = [&](const std::vector<int>& steps) {
    MultilevelSolver solver(size, {steps});
    cv::Mat1f solution(size, 0.0F);
    solver.solve(normal, rhs, 1, solution);
    return cv::norm(solution, wave) / cv::norm(wave);
  };
  CHECK(error_with({2, 6, 12}) < 0.5 * error_with({6}));
}

TEST_CASE("a solved problem stays solved, and nothing gives nothing") {
  const cv::Size size(30, 20);
  MotionOperator normal = random_operator(size, 31);
  MultilevelSolver solver(size, {{2, 6, 12}});
  const cv::Mat1f nothing(size, 0.0F);
  cv::Mat1f solution = nothing.clone();
  solver.solve(normal, nothing, 1, solution);
  CHECK(cv::norm(solution) == 0.0);
  const cv::Mat1f image = random_image(size, 32);
  cv::Mat1f rhs;
  normal.apply(image, rhs);
  solution = image.clone();
  solver.solve(normal, rhs, 1, solution);
  CHECK(cv::norm(solution, image) < 1e-3 * cv::norm(image));
}
