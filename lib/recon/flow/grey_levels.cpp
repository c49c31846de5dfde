#include "esi/recon/flow/grey_levels.hpp"

#include <cmath>

#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

constexpr float kNeutral = 127.5F;
/// Of L, below which there is nothing to show.
constexpr float kLeastDeviation = 1e-6F;

// OpenCV's meanStdDev and convertTo would do, but their last bits depend on the processor.

ESI_SIMD double squares_about(float centre, const float* __restrict row, int cols) {
  float sums[kVectorFloats] = {};
  int x = 0;
  for (; x + kVectorFloats <= cols; x += kVectorFloats) {
    for (int k = 0; k < kVectorFloats; ++k) sums[k] += (row[x + k] - centre) * (row[x + k] - centre);
  }
  double rest = 0.0;
  for (; x < cols; ++x) rest += static_cast<double>((row[x] - centre) * (row[x] - centre));
  return rest + sum_of(sums);
}

float mean_of(const cv::Mat1f& image) {
  double total = 0.0;
  for (int y = 0; y < image.rows; ++y) total += sum(image[y], image.cols);
  return static_cast<float>(total / static_cast<double>(image.total()));
}

float deviation_about(float mean, const cv::Mat1f& image) {
  double squares = 0.0;
  for (int y = 0; y < image.rows; ++y) squares += squares_about(mean, image[y], image.cols);
  return static_cast<float>(std::sqrt(squares / static_cast<double>(image.total())));
}

ESI_SIMD void scale_row(int cols, float gain, float offset, const float* __restrict in,
                        float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = gain * in[x] + offset;
}

}  // namespace

void grey_levels(const cv::Mat1f& log_intensity, double contrast_deviations, cv::Mat1f& levels) {
  levels.create(log_intensity.size());
  const float mean = mean_of(log_intensity);
  const float deviation = deviation_about(mean, log_intensity);
  if (deviation < kLeastDeviation) {
    levels.setTo(kNeutral);
    return;
  }
  const float gain = kNeutral / (static_cast<float>(contrast_deviations) * deviation);
  for (int y = 0; y < levels.rows; ++y)
    scale_row(levels.cols, gain, kNeutral - gain * mean, log_intensity[y], levels[y]);
}

}  // namespace esi
