#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace esi {

/// Solves matrix x = rhs for a few unknowns by Cholesky's method; the matrix is symmetric and has no negative
/// eigenvalues. From the first unknown on that adds nothing to the ones before it, to the rounding of
/// floats, all are 0.
std::vector<double> solve_small(const cv::Mat1d& matrix, const std::vector<double>& rhs);

}  // namespace esi
