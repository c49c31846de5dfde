#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "esi/core/event.hpp"

namespace esi {

/// A window's events as an image of `bins` channels: each event's polarity is shared between the two bins
/// next to its time,
///   s = (bins - 1) (t - t_first) / (t_last - t_first),  i = floor(s),  d = s - i
///   v[i](x, y) += w p (1 - d),  v[i + 1](x, y) += w p d
/// (Rebecq et al. 2019). Events at one time all go into the first bin. `weights` are empty (w = 1) or one a
/// piece. `grid` becomes 1 x bins x height x width of float, in memory of its own where it had another shape.
void fill_voxel_grid(std::span<const Event> events, std::span<const float> weights, int bins, SensorSize size,
                     cv::Mat& grid);

/// Gives the entries that aren't 0 the mean 0 and the deviation 1 (of the whole population, not the sample).
/// Where they are all equal, all become 0.
void normalise_non_zero(cv::Mat& grid);

}  // namespace esi
