#pragma once

#include <opencv2/core/mat.hpp>

#include "esi/core/row_team.hpp"

namespace esi {

/// Grey levels, not yet cut to 0 to 255: mid-grey for the mean of L, and white at so many deviations above
/// it.
void grey_levels(const cv::Mat1f& log_intensity, double contrast_deviations, cv::Mat1f& levels,
                 const RowTeam& team = kAlone);

}  // namespace esi
