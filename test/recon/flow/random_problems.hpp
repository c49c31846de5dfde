#pragma once

#include <opencv2/core.hpp>
#include <random>

#include "esi/recon/flow/motion_operator.hpp"

namespace esi::test {

/// Evenly between -largest and largest.
inline cv::Mat1f random_image(cv::Size size, unsigned seed, double largest = 1.0) {
  std::mt19937 random(seed);
  cv::Mat1f image(size);
  for (float& value : image)
    value = static_cast<float>(largest * (static_cast<double>(random()) / 2147483648.0 - 1.0));
  return image;
}

/// A is a sum of two random v v^T at every corner, with |v| up to 3 px.
inline MotionOperator random_operator(cv::Size size, unsigned seed) {
  MotionOperator normal(size);
  normal.eps = 0.02F;
  normal.mu = 0.0005F;
  for (unsigned i = 0; i < 2; ++i) {
    const cv::Mat1f d = random_image(size, 10 * seed + 2 * i, 2.0);
    const cv::Mat1f e = random_image(size, 10 * seed + 2 * i + 1, 2.0);
    for (int y = 0; y + 1 < size.height; ++y) {
      for (int x = 0; x + 1 < size.width; ++x) {
        normal.dd(y, x) += d(y, x) * d(y, x);
        normal.de(y, x) += d(y, x) * e(y, x);
        normal.ee(y, x) += e(y, x) * e(y, x);
      }
    }
  }
  return normal;
}

}  // namespace esi::test
