#include "esi/recon/flow/krylov_steps.hpp"

#include <catch2/catch.hpp>

#include "esi/recon/flow/padded_plane.hpp"
#include "recon/flow/least_squares_reference.hpp"
#include "recon/flow/random_problems.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const std::vector<cv::Size> kSizes{{1, 1},  {1, 7},  {2, 2},  {5, 4},  {15, 3},  {1, 70}, {70, 1},
                                   {2, 40}, {31, 3}, {16, 9}, {17, 9}, {33, 13}, {40, 20}};

cv::Mat1d in_double(const cv::Mat1f& image) {
  cv::Mat1d exact;
  image.convertTo(exact, CV_64F);
  return exact;
}

cv::Mat1f padded_copy(const cv::Mat1f& image) {
  cv::Mat1f plane = padded_plane(image.size());
  image.copyTo(plane);
  return plane;
}

cv::Mat1d diagonal_of(const LeastSquaresReference& reference) {
  cv::Mat1d diagonal(reference.size());
  for (int i = 0; i < static_cast<int>(diagonal.total()); ++i) {
    cv::Mat1d single(reference.size(), 0.0);
    single(i) = 1.0;
    diagonal(i) = reference.apply(single)(i);
  }
  return diagonal;
}

/// `steps` steps of conjugate gradients with Jacobi's preconditioner, from 0, as in the textbooks. Residuals
/// of less than 1e-7 of the first are as good as none.
cv::Mat1d conjugate_gradients(const LeastSquaresReference& reference, const cv::Mat1d& rhs, int steps) {
  const cv::Mat1d diagonal = diagonal_of(reference);
  cv::Mat1d solution(rhs.size(), 0.0);
  cv::Mat1d residual = rhs.clone();
  cv::Mat1d direction(residual / diagonal);
  double remaining = residual.dot(direction);
  const double enough = 1e-14 * remaining;
  for (int i = 0; i < steps && remaining > enough; ++i) {
    const cv::Mat1d product = reference.apply(direction);
    const double step = remaining / direction.dot(product);
    solution += step * direction;
    residual -= step * product;
    const cv::Mat1d preconditioned(residual / diagonal);
    const double next = residual.dot(preconditioned);
    direction = preconditioned + (next / remaining) * direction;
    remaining = next;
  }
  return solution;
}

/// How much less the energy x . M x - 2 rhs . x is than that of 0.
double gain(const LeastSquaresReference& reference, const cv::Mat1d& x, const cv::Mat1d& rhs) {
  return 2.0 * rhs.dot(x) - x.dot(reference.apply(x));
}

FirstStep no_step(cv::Size size) { return {0.0F, padded_plane(size), padded_plane(size)}; }

cv::Mat1f steps_at_once(const MotionOperator& normal, const cv::Mat1f& residual, int steps) {
  cv::Mat1f solution(residual.size(), 0.0F);
  cv::Mat1f rest = padded_copy(residual);
  KrylovSteps(residual.size(), steps).add_to(solution, normal, no_step(residual.size()), rest);
  return solution;
}

}  // namespace

TEST_CASE("steps at once are as good as one after another") {
  for (const cv::Size size : kSizes) {
    const MotionOperator normal = random_operator(size, 41);
    const LeastSquaresReference reference(normal);
    const cv::Mat1f residual = random_image(size, 42);
    for (const int steps : {0, 1, 2, 3, 4, 6, 7, 12}) {
      // As many steps as there are pixels would solve the problem; then only rounding is left to compare.
      if (2 * steps > size.area()) continue;
      INFO(size.width << "x" << size.height << ", " << steps << " steps");
      const cv::Mat1d expected = conjugate_gradients(reference, in_double(residual), steps);
      const cv::Mat1d shown = in_double(steps_at_once(normal, residual, steps));
      CHECK(gain(reference, shown, in_double(residual)) ==
            Approx(gain(reference, expected, in_double(residual))).epsilon(1e-4));
      if (steps <= 4) CHECK(cv::norm(shown, expected) <= 2e-3 * cv::norm(expected));
    }
  }
}

TEST_CASE("the first step is gone, and the others begin behind it") {
  for (const cv::Size size : {cv::Size(5, 4), cv::Size(40, 20)}) {
    const MotionOperator normal = random_operator(size, 45);
    const LeastSquaresReference reference(normal);
    const cv::Mat1f residual = random_image(size, 46);
    const cv::Mat1f start = random_image(size, 47);
    const cv::Mat1f direction = random_image(size, 48);
    cv::Mat1f product;
    normal.apply(direction, product);
    for (const int steps : {0, 3, 14}) {
      INFO(size.width << "x" << size.height << ", " << steps << " steps");
      cv::Mat1f solution = start.clone();
      cv::Mat1f rest = padded_copy(residual);
      KrylovSteps(size, steps)
          .add_to(solution, normal, {0.3F, padded_copy(direction), padded_copy(product)}, rest);
      const cv::Mat1f behind(residual - 0.3F * product);
      const cv::Mat1f expected(start + 0.3F * direction + steps_at_once(normal, behind, steps));
      CHECK(cv::norm(solution, expected) <= 1e-3 * cv::norm(expected));
    }
  }
}

TEST_CASE("no vector's energy is above four times that of the diagonal") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    // Motion along one line is the worst case: stripes across it.
    const cv::Size size(24, 18);
    MotionOperator normal = random_operator(size, seed);
    if (seed == 0) {
      for (cv::Mat1f* const a : {&normal.dd, &normal.de, &normal.ee})
        (*a)(cv::Rect(0, 0, size.width - 1, size.height - 1)).setTo(1.0F);
    }
    const LeastSquaresReference reference(normal);
    const cv::Mat1d diagonal = diagonal_of(reference);
    cv::Mat1d u = in_double(random_image(size, seed + 60));
    double largest = 0.0;
    for (int i = 0; i < 100; ++i) {
      const cv::Mat1d next = reference.apply(u);
      largest = u.dot(next) / u.dot(u.mul(diagonal));
      u = next / diagonal;
      u /= cv::norm(u);
    }
    INFO(largest);
    CHECK(largest <= 4.0);
    CHECK(largest > (seed == 0 ? 3.5 : 1.5));
  }
}

TEST_CASE("least energy from products of neighbours alone") {
  // A diagonal M: D^-1 M has these eigenvalues, D is 2 everywhere, and z_0 = D^-1 r.
  const std::vector<double> eigenvalues{0.1, 0.5, 1.3, 2.2, 3.1, 3.9};
  const std::vector<double> residual{1.0, -2.0, 0.5, 3.0, -1.0, 0.7};
  constexpr double kD = 2.0;
  constexpr int kVectors = 4;
  cv::Mat1d basis(kVectors + 1, 6);
  for (int i = 0; i < basis.cols; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double x = 0.5 * eigenvalues[at] - 1.0;
    for (int k = 0; k <= kVectors; ++k) basis(k, i) = std::cos(k * std::acos(x)) * residual[at] / kD;
  }
  const auto product = [&](int j, int k) {
    double sum = 0.0;
    for (int i = 0; i < basis.cols; ++i)
      sum += basis(j, i) * kD * eigenvalues[static_cast<std::size_t>(i)] * basis(k, i);
    return sum;
  };
  std::vector<KrylovProducts> products(kVectors);
  cv::Mat1d gram(kVectors, kVectors), right(kVectors, 1), expected;
  for (int k = 0; k < kVectors; ++k) {
    right(k) = basis.row(k).dot(cv::Mat1d(1, 6, const_cast<double*>(residual.data())));
    products[static_cast<std::size_t>(k)] = {product(k, k), product(k, k + 1), right(k)};
    for (int j = 0; j < kVectors; ++j) gram(j, k) = product(j, k);
  }
  cv::solve(gram, right, expected);
  const std::vector<float> shown = least_energy_factors(products);
  REQUIRE(shown.size() == kVectors);
  for (int k = 0; k < kVectors; ++k)
    CHECK(static_cast<double>(shown[static_cast<std::size_t>(k)]) == Approx(expected(k)).epsilon(1e-5));
}

TEST_CASE("a vector that is nothing new gets no share") {
  CHECK(least_energy_factors({}).empty());
  CHECK(least_energy_factors({KrylovProducts{}, KrylovProducts{}}) == std::vector<float>{0.0F, 0.0F});
  // X z_0 = z_0 / 2: all energy is in z_0.
  const std::vector<float> shown = least_energy_factors({{4.0, 2.0, 8.0}, {1.0, -1.0, 4.0}});
  CHECK(shown == std::vector<float>{2.0F, 0.0F});
}
