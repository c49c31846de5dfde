#include "esi/recon/flow/grey_levels.hpp"

#include <cmath>
#include <numeric>
#include <vector>

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

/// Of a number that each row has, over all pixels.
template <class OfRow>
double mean_of_rows(const cv::Mat1f& image, const RowTeam& team, const OfRow& of_row) {
  std::vector<double> sums(static_cast<std::size_t>(image.rows));
  team.over_rows(image.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) sums[static_cast<std::size_t>(y)] = of_row(image[y]);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(image.total());
}

ESI_SIMD void scale_row(int cols, float gain, float offset, const float* __restrict in,
                        float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = gain * in[x] + offset;
}

}  // namespace

void grey_levels(const cv::Mat1f& log_intensity, double contrast_deviations, cv::Mat1f& levels,
                 const RowTeam& team) {
  levels.create(log_intensity.size());
  const int cols = log_intensity.cols;
  const auto mean = static_cast<float>(
      mean_of_rows(log_intensity, team, [cols](const float* row) { return sum(row, cols); }));
  const double variance =
      mean_of_rows(log_intensity, team, [=](const float* row) { return squares_about(mean, row, cols); });
  const auto deviation = static_cast<float>(std::sqrt(variance));
  if (deviation < kLeastDeviation) {
    levels.setTo(kNeutral);
    return;
  }
  const float gain = kNeutral / (static_cast<float>(contrast_deviations) * deviation);
  team.over_rows(levels.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      scale_row(cols, gain, kNeutral - gain * mean, log_intensity[y], levels[y]);
  });
}

}  // namespace esi
