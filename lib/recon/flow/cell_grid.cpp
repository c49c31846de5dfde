#include "esi/recon/flow/cell_grid.hpp"

#include <algorithm>
#include <cmath>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

int cells_over(int pixels, double cell_px) { return static_cast<int>(std::ceil(pixels / cell_px)); }

/// Between two neighbours on a line of cells, for columns [begins[i], begins[i + 1]).
ESI_SIMD void interpolate(std::size_t stretches, const float* __restrict line, const int* __restrict begins,
                          const float* __restrict share, float* __restrict out) {
  for (std::size_t i = 0; i < stretches; ++i) {
    const float left = line[i];
    const float rise = line[i + 1] - left;
    for (int x = begins[i]; x < begins[i + 1]; ++x) out[x] = left + share[x] * rise;
  }
}

}  // namespace

CellGrid::CellGrid(cv::Size image, double cell_px)
    : cell_px_(cell_px),
      cols_(cells_over(image.width, cell_px)),
      rows_(cells_over(image.height, cell_px)),
      line_(static_cast<std::size_t>(cols_) + 2) {
  for (int x = 0; x < image.width; ++x) {
    const double at = (x + 0.5) / cell_px + 0.5;
    const int left = std::min(static_cast<int>(at), cols_);
    begins_.resize(static_cast<std::size_t>(left) + 1, x);
    share_.push_back(static_cast<float>(at - left));
  }
  begins_.resize(line_.size(), image.width);
}

void CellGrid::interpolate_row(const cv::Mat1f& cells, int y, float scale, float* out) {
  const double at = std::clamp((y + 0.5) / cell_px_ - 0.5, 0.0, rows_ - 1.0);
  const int above = static_cast<int>(at);
  const auto share = static_cast<float>(at - above);
  const float* const upper = cells[above];
  const float* const lower = cells[std::min(above + 1, rows_ - 1)];
  for (int i = 0; i < cols_; ++i) {
    line_[static_cast<std::size_t>(i) + 1] = scale * (upper[i] + share * (lower[i] - upper[i]));
  }
  line_.front() = line_[1];
  line_.back() = line_[static_cast<std::size_t>(cols_)];
  interpolate(begins_.size() - 1, line_.data(), begins_.data(), share_.data(), out);
}

}  // namespace esi
