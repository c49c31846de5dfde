#pragma once

#include <algorithm>
#include <cmath>

#include "esi/recon/reconstructor.hpp"

namespace esi::test {

/// The largest difference of a grey level at t_us from `level(x, y, t_us)`.
template <class Reference>
double largest_level_error(Reconstructor& method, const Reference& reference, std::int64_t t_us) {
  cv::Mat1f levels;
  method.render_levels(t_us, levels);
  double worst = 0.0;
  for (int y = 0; y < levels.rows; ++y) {
    for (int x = 0; x < levels.cols; ++x) {
      worst = std::max(worst, std::abs(static_cast<double>(levels(y, x)) - reference.level(x, y, t_us)));
    }
  }
  return worst;
}

}  // namespace esi::test
