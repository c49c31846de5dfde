#include "esi/recon/flow/krylov_products.hpp"

#include <cmath>
#include <opencv2/core.hpp>

#include "esi/recon/flow/row_sums.hpp"

namespace esi {
namespace {

/// Of a vector's energy, what must be left of it without the vectors before it: its entries are floats.
constexpr double kLeastNew = 1e-6;

/// m_j = z_0 . M T_j z_0, from j = 0 on.
std::vector<double> moments_of(const std::vector<KrylovProducts>& products) {
  std::vector<double> moments;
  for (const KrylovProducts& of : products) {
    const bool is_first = moments.empty();
    moments.push_back(is_first ? of.own : 2.0 * of.own - moments[0]);
    moments.push_back(is_first ? of.next : 2.0 * of.next - moments[1]);
  }
  return moments;
}

cv::Mat1d gram_of(const std::vector<KrylovProducts>& products) {
  const std::vector<double> moments = moments_of(products);
  const auto moment = [&](int j) { return moments[static_cast<std::size_t>(j)]; };
  const auto count = static_cast<int>(products.size());
  cv::Mat1d gram(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) gram(i, j) = 0.5 * (moment(i + j) + moment(std::abs(i - j)));
  }
  return gram;
}

/// Puts Cholesky's factor of `gram` below its diagonal; returns how many vectors it goes for.
int factorise(cv::Mat1d& gram) {
  for (int i = 0; i < gram.rows; ++i) {
    const double energy = gram(i, i);
    for (int j = 0; j < i; ++j) {
      for (int k = 0; k < j; ++k) gram(i, j) -= gram(i, k) * gram(j, k);
      gram(i, j) /= gram(j, j);
      gram(i, i) -= gram(i, j) * gram(i, j);
    }
    if (energy < kNothing || gram(i, i) < kLeastNew * energy) return i;
    gram(i, i) = std::sqrt(gram(i, i));
  }
  return gram.rows;
}

}  // namespace

std::vector<float> least_energy_factors(const std::vector<KrylovProducts>& products) {
  cv::Mat1d factor = gram_of(products);
  const int count = factorise(factor);
  std::vector<double> f(products.size(), 0.0);
  const auto at = [&f](int i) -> double& { return f[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < count; ++i) {
    at(i) = products[static_cast<std::size_t>(i)].residual;
    for (int k = 0; k < i; ++k) at(i) -= factor(i, k) * at(k);
    at(i) /= factor(i, i);
  }
  for (int i = count; i-- > 0;) {
    for (int k = i + 1; k < count; ++k) at(i) -= factor(k, i) * at(k);
    at(i) /= factor(i, i);
  }
  return {f.begin(), f.end()};
}

}  // namespace esi
