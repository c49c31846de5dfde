#pragma once

#include <vector>

namespace esi {

/// Scalar products of a vector of KrylovSteps' basis.
struct KrylovProducts {
  double own = 0.0;       ///< z_k . M z_k
  double next = 0.0;      ///< z_(k+1) . M z_k, of the last vector not needed
  double residual = 0.0;  ///< z_k . r
};

/// The combination sum f_k z_k that makes the energy least: G f = z . r, where G_ij = z_i . M z_j. Since
/// T_i T_j = (T_(i+j) + T_|i-j|) / 2, G comes from products of neighbours alone. As many f as there are
/// vectors; those that add nothing to the ones before them, to rounding, have 0.
std::vector<float> least_energy_factors(const std::vector<KrylovProducts>& products);

}  // namespace esi
