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

ESI_SIMD void scale_row(int cols, float gain, float offset, const float* __restrict in,
                        float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = gain * in[x] + offset;
}

}  // namespace

void grey_levels(const cv::Mat1f& log_intensity, double contrast_deviations, cv::Mat1f& levels,
                 const RowTeam& team) {
  levels.create(log_intensity.size());
  const cv::Size size = log_intensity.size();
  const auto pixels = static_cast<double>(log_intensity.total());
  const auto sum_of_row = [&](int y) { return sum(log_intensity[y], size.width); };
  const auto mean = static_cast<float>(sum_over_rows(team, size, sum_of_row) / pixels);
  const auto squares_of_row = [&](int y) { return squares_about(mean, log_intensity[y], size.width); };
  const auto deviation = static_cast<float>(std::sqrt(sum_over_rows(team, size, squares_of_row) / pixels));
  if (deviation < kLeastDeviation) {
    levels.setTo(kNeutral);
    return;
  }
  const float gain = kNeutral / (static_cast<float>(contrast_deviations) * deviation);
  team.over_rows(size, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      scale_row(size.width, gain, kNeutral - gain * mean, log_intensity[y], levels[y]);
  });
}

}  // namespace esi
