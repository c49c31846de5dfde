#include "esi/recon/flow/krylov_products.hpp"

#include <cmath>
#include <opencv2/core/mat.hpp>

#include "esi/recon/flow/small_system.hpp"

namespace esi {
namespace {

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

}  // namespace

std::vector<float> least_energy_factors(const std::vector<KrylovProducts>& products) {
  std::vector<double> rhs;
  rhs.reserve(products.size());
  for (const KrylovProducts& of : products) rhs.push_back(of.residual);
  const std::vector<double> factors = solve_small(gram_of(products), rhs);
  return {factors.begin(), factors.end()};
}

}  // namespace esi
