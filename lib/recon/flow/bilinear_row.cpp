#include "esi/recon/flow/bilinear_row.hpp"

#include <algorithm>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// Pixels that are compared at once.
constexpr int kBlock = 8;

ESI_SIMD void place_row(int cols, int rows, int y, const float* __restrict vx, const float* __restrict vy,
                        float scale, float offset, int* __restrict shift, float* __restrict right,
                        float* __restrict below) {
  const auto last_x = static_cast<float>(cols - 1);
  const auto last_y = static_cast<float>(rows - 1);
  const int last_left = std::max(cols - 2, 0);
  const int last_above = std::max(rows - 2, 0);
  for (int x = 0; x < cols; ++x) {
    const float at_x = std::min(std::max(static_cast<float>(x) + offset - scale * vx[x], 0.0F), last_x);
    const float at_y = std::min(std::max(static_cast<float>(y) + offset - scale * vy[x], 0.0F), last_y);
    const int left = std::min(static_cast<int>(at_x), last_left);
    const int above = std::min(static_cast<int>(at_y), last_above);
    shift[x] = above * cols + left - x;
    right[x] = at_x - static_cast<float>(left);
    below[x] = at_y - static_cast<float>(above);
  }
}

/// Where runs of equal shifts end; returns how many there are.
ESI_SIMD std::size_t find_runs(int cols, const int* __restrict shift, int* __restrict ends) {
  std::size_t runs = 0;
  for (int x = 0; x < cols; ++runs) {
    const int own = shift[x];
    for (int differs = 0; x + kBlock <= cols; x += kBlock) {
      for (int k = 0; k < kBlock; ++k) differs |= shift[x + k] ^ own;
      if (differs != 0) break;
    }
    while (x < cols && shift[x] == own) ++x;
    ends[runs] = x;
  }
  return runs;
}

/// Pixels of one shift look up pixels that lie side by side, too.
ESI_SIMD void sample_runs(std::size_t runs, const int* __restrict ends, const int* __restrict shift,
                          const float* __restrict image, int to_right, int to_below,
                          const float* __restrict right, const float* __restrict below,
                          float* __restrict out) {
  int x = 0;
  for (std::size_t i = 0; i < runs; ++i) {
    const int own = shift[x];
    for (; x < ends[i]; ++x) {
      const float* const at = image + (own + x);
      const float upper = at[0] + right[x] * (at[to_right] - at[0]);
      const float lower = at[to_below] + right[x] * (at[to_below + to_right] - at[to_below]);
      out[x] = upper + below[x] * (lower - upper);
    }
  }
}

}  // namespace

BilinearRow::BilinearRow(cv::Size size)
    : size_(size),
      shift_(static_cast<std::size_t>(size.width)),
      run_ends_(shift_.size()),
      right_(shift_.size()),
      below_(shift_.size()) {}

void BilinearRow::place(int y, const float* vx, const float* vy, float scale, float offset) {
  place_row(size_.width, size_.height, y, vx, vy, scale, offset, shift_.data(), right_.data(), below_.data());
  runs_ = find_runs(size_.width, shift_.data(), run_ends_.data());
}

void BilinearRow::sample(const cv::Mat1f& image, float* out) const {
  // A single column or row is its own neighbour.
  const int to_right = size_.width > 1 ? 1 : 0;
  const int to_below = size_.height > 1 ? size_.width : 0;
  sample_runs(runs_, run_ends_.data(), shift_.data(), image[0], to_right, to_below, right_.data(),
              below_.data(), out);
}

}  // namespace esi
