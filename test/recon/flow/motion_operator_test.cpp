#include "esi/recon/flow/motion_operator.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "recon/flow/least_squares_reference.hpp"
#include "recon/flow/random_problems.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const std::vector<cv::Size> kSizes{{1, 1}, {1, 7}, {7, 1}, {2, 2}, {3, 5}, {16, 9}, {41, 33}, {70, 35}};

}  // namespace

TEST_CASE("the operator is the energy's gradient, also at the border") {
  for (const cv::Size size : kSizes) {
    INFO(size.width << "x" << size.height);
    MotionOperator normal = random_operator(size, 3);
    const LeastSquaresReference reference(normal);
    const cv::Mat1f image = random_image(size, 4);
    cv::Mat1f out;
    const double product = normal.apply(image, out);
    cv::Mat1d exact_image;
    image.convertTo(exact_image, CV_64F);
    const cv::Mat1d exact = reference.apply(exact_image);
    cv::Mat1d shown;
    out.convertTo(shown, CV_64F);
    CHECK(cv::norm(shown, exact, cv::NORM_INF) <= 1e-5 * cv::norm(exact, cv::NORM_INF));
    CHECK(product == Approx(exact_image.dot(exact)).epsilon(1e-4));
  }
}

TEST_CASE("the operator is symmetric and positive definite on random A") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const cv::Size size = kSizes[seed % kSizes.size()];
    MotionOperator normal = random_operator(size, seed);
    const cv::Mat1f u = random_image(size, 2 * seed + 100);
    const cv::Mat1f w = random_image(size, 2 * seed + 101);
    cv::Mat1f mu, mw;
    const double energy = normal.apply(u, mu);
    normal.apply(w, mw);
    CHECK(mu.dot(w) == Approx(u.dot(mw)).margin(1e-5 * cv::norm(mu) * cv::norm(w)));
    CHECK(energy >= static_cast<double>(normal.mu) * u.dot(u) * 0.999);
  }
}

TEST_CASE("the diagonal is what a single pixel gets back") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(5, 4), cv::Size(6, 1)}) {
    const MotionOperator normal = random_operator(size, 7);
    cv::Mat1f inverse(size), out;
    for (int y = 0; y < size.height; ++y) normal.inverse_diagonal_row(y, inverse[y]);
    for (int i = 0; i < static_cast<int>(inverse.total()); ++i) {
      cv::Mat1f single(size, 0.0F);
      single(i) = 1.0F;
      CHECK(normal.apply(single, out) == Approx(1.0 / static_cast<double>(inverse(i))).epsilon(1e-5));
    }
  }
}

TEST_CASE("A on half the resolution is the mean around the same place") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 3), cv::Size(2, 9), cv::Size(41, 34)}) {
    const MotionOperator fine = random_operator(size, 8);
    const cv::Size half((size.width + 1) / 2, (size.height + 1) / 2);
    MotionOperator coarse(half);
    fine.coarsen(coarse);
    cv::Mat1f expected(half, 0.0F);
    for (int y = 0; y + 1 < half.height; ++y) {
      for (int x = 0; x + 1 < half.width; ++x) {
        for (const cv::Point by : {cv::Point(0, 0), cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)})
          expected(y, x) += static_cast<float>(
              0.25 * cv::mean(fine.de(cv::Rect(cv::Point(2 * x, 2 * y) + by, cv::Size(2, 2))))[0]);
      }
    }
    CHECK(cv::norm(coarse.de, expected, cv::NORM_INF) < 1e-5);
  }
}

TEST_CASE("on half the resolution a ramp costs what it costs on the full one") {
  const cv::Size size(64, 48);
  MotionOperator fine(size);
  fine.eps = 0.1F;
  fine.mu = 1e-9F;
  for (cv::Mat1f* const a : {&fine.dd, &fine.de, &fine.ee}) {
    (*a)(cv::Rect(0, 0, size.width - 1, size.height - 1)).setTo(a == &fine.de ? 0.2F : 0.5F);
  }
  MotionOperator coarse({32, 24});
  fine.coarsen(coarse);
  cv::Mat1f ramp(size), half_ramp(coarse.size()), out;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) ramp(y, x) = static_cast<float>(x + 2 * y);
  }
  for (int y = 0; y < half_ramp.rows; ++y) {
    for (int x = 0; x < half_ramp.cols; ++x) half_ramp(y, x) = static_cast<float>(2 * x + 4 * y);
  }
  // Energy per area; the border has one row of corners less of either kind.
  const double on_fine = fine.apply(ramp, out) / (63.0 * 47.0);
  const double on_coarse = coarse.apply(half_ramp, out) / (4.0 * 31.0 * 23.0);
  CHECK(on_coarse == Approx(on_fine).epsilon(0.01));
  CHECK(coarse.mu == 4.0F * fine.mu);
}
