#pragma once

#include <opencv2/core/mat.hpp>

#include "esi/core/row_team.hpp"
#include "esi/recon/steps/gaussian.hpp"

namespace esi {

/// Pixels of the full resolution along the side of one of the half.
constexpr float kHalf = 2.0F;

/// Half the sides, rounded up.
inline cv::Size half_of(cv::Size size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

/// The sum of 2x2 pixels, each times `factor`. An odd last row or column counts twice.
void sum_by_twos(const cv::Mat1f& image, float factor, cv::Mat1f& half, const RowTeam& team = kAlone);

/// What the flow is estimated on: half the resolution, and a Gaussian of `deviation_px` of that.
class SmoothHalf {
 public:
  explicit SmoothHalf(double deviation_px) : gaussian_(deviation_px) {}

  void operator()(const cv::Mat1f& image, cv::Mat1f& half, const RowTeam& team = kAlone) {
    sum_by_twos(image, 0.25F, half, team);
    gaussian_.apply(half, team);
  }

 private:
  Gaussian gaussian_;
};

}  // namespace esi
