#pragma once

#include <opencv2/core/mat.hpp>

#include "esi/core/event.hpp"

// What stands before and after a network: sizes it can halve often enough, and grey levels out of its image.

namespace esi {

/// Rows and columns that are added around an image. Where they can't be even, there is one more above and on
/// the left.
struct Padding {
  int top = 0;
  int bottom = 0;
  int left = 0;
  int right = 0;

  /// Up to the next multiples of `multiple_px`.
  static Padding to_multiple(SensorSize size, int multiple_px);
};

/// Mirrors each channel of a 1 x channels x height x width grid into its padding, the border pixels
/// themselves not repeated.
void pad_reflected(const cv::Mat& grid, const Padding& padding, cv::Mat& padded);

/// I + amount (I - G I), G of 5 x 5 pixels, zeros around the image. G is the one that E2VID was published
/// with: its factor along x and along y is sqrt(P(k)), P(k) the normal distribution's share of the k-th fifth
/// of
/// [-1.3, 1.3], which is much flatter than a Gaussian of 1 px.
cv::Mat1f unsharp(const cv::Mat1f& image, double amount);

/// The image's middle, without its padding.
cv::Mat1f without_padding(const cv::Mat1f& image, const Padding& padding);

/// Grey levels that show `low` black and `high` white. Where the two are equal, all are mid-grey.
void levels_between(const cv::Mat1f& image, float low, float high, cv::Mat1f& levels);

/// The value that `percent` of 100 values lie below; between two values, in proportion.
float percentile(const cv::Mat1f& image, double percent);

/// Shown where there is nothing to show.
inline constexpr float kMidGrey = 128.0F;

}  // namespace esi
