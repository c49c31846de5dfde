#include "esi/recon/flow/small_system.hpp"

#include <cmath>
#include <opencv2/core.hpp>

#include "esi/recon/flow/row_sums.hpp"

namespace esi {
namespace {

/// Of an unknown's energy, what must be left of it without those before it: entries are sums of floats.
constexpr double kLeastNew = 1e-6;

/// Puts Cholesky's factor below the diagonal; returns for how many unknowns it goes.
int factorise(cv::Mat1d& matrix) {
  for (int i = 0; i < matrix.rows; ++i) {
    const double energy = matrix(i, i);
    for (int j = 0; j < i; ++j) {
      for (int k = 0; k < j; ++k) matrix(i, j) -= matrix(i, k) * matrix(j, k);
      matrix(i, j) /= matrix(j, j);
      matrix(i, i) -= matrix(i, j) * matrix(i, j);
    }
    if (energy < kNothing || matrix(i, i) < kLeastNew * energy) return i;
    matrix(i, i) = std::sqrt(matrix(i, i));
  }
  return matrix.rows;
}

}  // namespace

std::vector<double> solve_small(const cv::Mat1d& matrix, const std::vector<double>& rhs) {
  cv::Mat1d factor = matrix.clone();
  const int count = factorise(factor);
  std::vector<double> x(rhs.size(), 0.0);
  const auto at = [&x](int i) -> double& { return x[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < count; ++i) {
    at(i) = rhs[static_cast<std::size_t>(i)];
    for (int k = 0; k < i; ++k) at(i) -= factor(i, k) * at(k);
    at(i) /= factor(i, i);
  }
  for (int i = count; i-- > 0;) {
    for (int k = i + 1; k < count; ++k) at(i) -= factor(k, i) * at(k);
    at(i) /= factor(i, i);
  }
  return x;
}

}  // namespace esi
