#include "esi/recon/flow/brightness_model.hpp"

#include <cmath>
#include <vector>

#include "esi/recon/flow/row_motion.hpp"
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
      moved_l_(size, 0.0F) {
  operator_.eps = options.eps;
  operator_.mu = options.mu;
}

void BrightnessModel::take(const cv::Mat1f& b, double duration, const MotionField& field,
                           const CellGrid& cells, const RowTeam& team) {
  memory_ = static_cast<float>(std::pow(options_.memory, duration));
  weight_ = static_cast<float>(1.0 / duration);
  team.over_rows(log_intensity_.size(), [&](int begin, int end) {
    RowMotion motion(log_intensity_.size(), cells);
    std::vector<float> moved_b(motion.x.size());
    for (int y = begin; y < end; ++y) {
      motion.look_up(field, y, 1.0F);
      move_row(y, b, motion, moved_b.data());
    }
  });
  repeat_last_corners(moved_d_);
  repeat_last_corners(moved_e_);
  cv::swap(a_d_, moved_d_);
  cv::swap(a_e_, moved_e_);
  cv::swap(log_intensity_, moved_l_);
}

void BrightnessModel::move_row(int y, const cv::Mat1f& b, RowMotion& motion, float* moved_b) {
  const float* const vx = motion.x.data();
  const float* const vy = motion.y.data();
  motion.lookup.sample(log_intensity_, moved_l_[y]);
  if (y + 1 == log_intensity_.rows) return;
  motion.lookup.sample(a_d_, moved_d_[y]);
  motion.lookup.sample(a_e_, moved_e_[y]);
  motion.lookup.place(y, vx, vy, 0.5F, 0.5F);
  motion.lookup.sample(b, moved_b);
  accumulate(log_intensity_.cols - 1, vx, vy, moved_b, memory_, 1.0F / options_.memory_px, weight_,
             operator_.dd[y], operator_.de[y], operator_.ee[y], moved_d_[y], moved_e_[y]);
}

void BrightnessModel::move_image(const MotionField& field, const CellGrid& cells, float share,
                                 cv::Mat1f& moved, const RowTeam& team) const {
  moved.create(log_intensity_.size());
  team.over_rows(moved.size(), [&](int begin, int end) {
    RowMotion motion(moved.size(), cells);
    for (int y = begin; y < end; ++y) {
      motion.look_up(field, y, share);
      motion.lookup.sample(log_intensity_, moved[y]);
    }
  });
}

void BrightnessModel::turn(const cv::Mat1f& signs, CellGrid cells) {
  std::vector<float> sign(static_cast<std::size_t>(log_intensity_.cols));
  for (int y = 0; y < log_intensity_.rows; ++y) {
    cells.interpolate_row(signs, y, 1.0F, sign.data());
    for (cv::Mat1f* plane : {&log_intensity_, &a_d_, &a_e_})
      for (std::size_t x = 0; x < sign.size(); ++x) (*plane)[y][x] *= sign[x];
  }
}

void BrightnessModel::right_hand_side(cv::Mat1f& rhs, const RowTeam& team) const {
  rhs.create(a_d_.size());
  // Outside there are no corners.
  const cv::Mat1f none(1, rhs.cols, 0.0F);
  team.over_rows(rhs.size(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) right_hand_side_row(y, none[0], rhs);
  });
}

void BrightnessModel::right_hand_side_row(int y, const float* none, cv::Mat1f& rhs) const {
  const int last = rhs.cols - 1;
  const float* const above_d = y > 0 ? a_d_[y - 1] : none;
  const float* const above_e = y > 0 ? a_e_[y - 1] : none;
  const float* const below_d = y + 1 < rhs.rows ? a_d_[y] : none;
  const float* const below_e = y + 1 < rhs.rows ? a_e_[y] : none;
  minus_divergence(1, last, above_d, above_e, below_d, below_e, rhs[y]);
  rhs(y, last) = last > 0 ? above_d[last - 1] + below_e[last - 1] : 0.0F;
  rhs(y, 0) = last > 0 ? -below_d[0] - above_e[0] : 0.0F;
}

}  // namespace esi
