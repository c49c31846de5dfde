#include "esi/recon/flow/brightness_model.hpp"

#include <cmath>

#include "esi/recon/simd.hpp"

namespace esi {
namespace {

ESI_SIMD void accumulate(int corners, const float* __restrict vx, const float* __restrict vy,
                         const float* __restrict b, float memory, float per_px, float weight,
                         float* __restrict dd, float* __restrict de, float* __restrict ee,
                         float* __restrict a_d, float* __restrict a_e) {
  for (int x = 0; x < corners; ++x) {
    const float along_d = 0.5F * (vx[x] + vy[x]);
    const float along_e = 0.5F * (vx[x] - vy[x]);
    const float length = std::sqrt(vx[x] * vx[x] + vy[x] * vy[x]);
    const float lambda = memory / (1.0F + length * per_px);
    dd[x] = lambda * dd[x] + weight * along_d * along_d;
    de[x] = lambda * de[x] + weight * along_d * along_e;
    ee[x] = lambda * ee[x] + weight * along_e * along_e;
    a_d[x] = lambda * a_d[x] - weight * along_d * b[x];
    a_e[x] = lambda * a_e[x] - weight * along_e * b[x];
  }
}

/// Minus the divergence for pixels that have a corner on each side. D grows to the lower right, E to the
/// upper.
ESI_SIMD void minus_divergence(int begin, int end, const float* __restrict above_d,
                               const float* __restrict above_e, const float* __restrict below_d,
                               const float* __restrict below_e, float* __restrict out) {
  for (int x = begin; x < end; ++x) out[x] = (above_d[x - 1] - below_d[x]) + (below_e[x - 1] - above_e[x]);
}

/// There is a corner less than pixels; where corners are looked up beyond the last ones, those go on.
void repeat_last_corners(cv::Mat1f& corners) {
  if (corners.rows < 2 || corners.cols < 2) return;
  corners.col(corners.cols - 2).copyTo(corners.col(corners.cols - 1));
  corners.row(corners.rows - 2).copyTo(corners.row(corners.rows - 1));
}

}  // namespace

BrightnessModel::BrightnessModel(cv::Size size, const Options& options)
    : options_(options),
      operator_(size),
      a_d_(size, 0.0F),
      a_e_(size, 0.0F),
      log_intensity_(size, 0.0F),
      moved_d_(size, 0.0F),
      moved_e_(size, 0.0F),
      moved_l_(size, 0.0F),
      lookup_(size),
      vx_(static_cast<std::size_t>(size.width)),
      vy_(vx_.size()),
      b_(vx_.size()) {
  operator_.eps = options.eps;
  operator_.mu = options.mu;
}

void BrightnessModel::take(const cv::Mat1f& b, const MotionField& field, CellGrid& cells) {
  for (int y = 0; y < log_intensity_.rows; ++y) {
    cells.interpolate_row(field.x, y, 1.0F, vx_.data());
    cells.interpolate_row(field.y, y, 1.0F, vy_.data());
    move_row(y, b);
  }
  repeat_last_corners(moved_d_);
  repeat_last_corners(moved_e_);
  cv::swap(a_d_, moved_d_);
  cv::swap(a_e_, moved_e_);
  cv::swap(log_intensity_, moved_l_);
}

void BrightnessModel::move_row(int y, const cv::Mat1f& b) {
  lookup_.place(y, vx_.data(), vy_.data(), 1.0F);
  lookup_.sample(log_intensity_, moved_l_[y]);
  if (y + 1 == log_intensity_.rows) return;
  lookup_.sample(a_d_, moved_d_[y]);
  lookup_.sample(a_e_, moved_e_[y]);
  lookup_.place(y, vx_.data(), vy_.data(), 0.5F, 0.5F);
  lookup_.sample(b, b_.data());
  accumulate(log_intensity_.cols - 1, vx_.data(), vy_.data(), b_.data(), options_.memory,
             1.0F / options_.memory_px, options_.weight, operator_.dd[y], operator_.de[y], operator_.ee[y],
             moved_d_[y], moved_e_[y]);
}

void BrightnessModel::move_image(const MotionField& field, CellGrid& cells, float share, cv::Mat1f& moved) {
  moved.create(log_intensity_.size());
  for (int y = 0; y < moved.rows; ++y) {
    cells.interpolate_row(field.x, y, share, vx_.data());
    cells.interpolate_row(field.y, y, share, vy_.data());
    lookup_.place(y, vx_.data(), vy_.data(), 1.0F);
    lookup_.sample(log_intensity_, moved[y]);
  }
}

void BrightnessModel::right_hand_side(cv::Mat1f& rhs) const {
  rhs.create(a_d_.size());
  // Outside there are no corners.
  const cv::Mat1f none(1, rhs.cols, 0.0F);
  const int last = rhs.cols - 1;
  for (int y = 0; y < rhs.rows; ++y) {
    const float* const above_d = y > 0 ? a_d_[y - 1] : none[0];
    const float* const above_e = y > 0 ? a_e_[y - 1] : none[0];
    const float* const below_d = y + 1 < rhs.rows ? a_d_[y] : none[0];
    const float* const below_e = y + 1 < rhs.rows ? a_e_[y] : none[0];
    minus_divergence(1, last, above_d, above_e, below_d, below_e, rhs[y]);
    rhs(y, last) = last > 0 ? above_d[last - 1] + below_e[last - 1] : 0.0F;
    rhs(y, 0) = last > 0 ? -below_d[0] - above_e[0] : 0.0F;
  }
}

}  // namespace esi
