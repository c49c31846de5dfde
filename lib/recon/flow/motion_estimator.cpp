#include "esi/recon/flow/motion_estimator.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "esi/recon/flow/cell_smoothing.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// Pixels of the full resolution in one of the half.
constexpr float kHalf = 2.0F;
/// Of a window's motion: nothing that is faster can be followed.
constexpr float kLargest_px = 64.0F;

ESI_SIMD void mean_and_difference(int cols, const float* __restrict moved, const float* __restrict after,
                                  float* __restrict mean, float* __restrict difference) {
  for (int x = 0; x < cols; ++x) {
    mean[x] = 0.5F * (moved[x] + after[x]);
    difference[x] = after[x] - moved[x];
  }
}

/// Adds a row's terms of T and rhs, for columns that have both neighbours.
ESI_SIMD void add_terms(int cols, const float* __restrict above, const float* __restrict here,
                        const float* __restrict below, const float* __restrict difference,
                        float tensor_factor, float rhs_factor, float* __restrict xx, float* __restrict xy,
                        float* __restrict yy, float* __restrict rx, float* __restrict ry) {
  for (int x = 1; x < cols - 1; ++x) {
    const float gx = here[x + 1] - here[x - 1];
    const float gy = below[x] - above[x];
    xx[x] += tensor_factor * gx * gx;
    xy[x] += tensor_factor * gx * gy;
    yy[x] += tensor_factor * gy * gy;
    rx[x] += rhs_factor * gx * difference[x];
    ry[x] += rhs_factor * gy * difference[x];
  }
}

void take_median(cv::Mat1f& cells) {
  cv::Mat1f medians;
  cv::medianBlur(cells, medians, 3);
  cells = medians;
}

}  // namespace

MotionEstimator::MotionEstimator(cv::Size full, const Options& options)
    : options_(options),
      half_((full.width + 1) / 2, (full.height + 1) / 2),
      cells_(half_, options.cell_px / static_cast<double>(kHalf)),
      lookup_(half_) {
  const auto cols = static_cast<std::size_t>(half_.width);
  for (auto* row : {&vx_, &vy_, &moved_}) row->resize(cols);
  for (auto& column : columns_) column.resize(cols);
  for (cv::Mat1f& sum : sums_) sum.create(cells_.size());
  for (int x = 0; x < half_.width; ++x) column_cells_.push_back(cells_.cell_of(x));
}

void MotionEstimator::improve(std::span<const MovedPair> pairs, MotionField& field) {
  for (int round = 0; round < options_.rounds; ++round) {
    for (cv::Mat1f& sum : sums_) sum.setTo(0.0F);
    add_terms_of(pairs, field);
    for (cv::Mat1f& sum : sums_) {
      smooth_cells(sum);
      smooth_cells(sum);
    }
    step(field);
  }
  take_median(field.x);
  take_median(field.y);
}

void MotionEstimator::add_terms_of(std::span<const MovedPair> pairs, const MotionField& field) {
  compared_.resize(pairs.size());
  for (Compared& pair : compared_) {
    pair.mean.create(3, half_.width);
    pair.difference.create(3, half_.width);
  }
  for (int y = 0; y < half_.height; ++y) {
    compensate_row(pairs, field, y);
    const int middle = y - 1;
    if (middle < 1) continue;
    for (std::size_t i = 0; i < pairs.size(); ++i) add_row(pairs[i], compared_[i], middle);
    if (cells_.cell_of(middle + 1) != cells_.cell_of(middle)) end_cells(cells_.cell_of(middle));
  }
  if (half_.height > 2) end_cells(cells_.cell_of(half_.height - 2));
}

void MotionEstimator::compensate_row(std::span<const MovedPair> pairs, const MotionField& field, int y) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const MovedPair& pair = pairs[i];
    if (i == 0 || pair.windows != pairs[i - 1].windows) {
      cells_.interpolate_row(field.x, y, pair.windows / kHalf, vx_.data());
      cells_.interpolate_row(field.y, y, pair.windows / kHalf, vy_.data());
      lookup_.place(y, vx_.data(), vy_.data(), 1.0F);
    }
    lookup_.sample(pair.before, moved_.data());
    mean_and_difference(half_.width, moved_.data(), pair.after[y], compared_[i].mean[y % 3],
                        compared_[i].difference[y % 3]);
  }
}

void MotionEstimator::add_row(const MovedPair& pair, const Compared& compared, int y) {
  // A step of 1 px a window moves the pair by so many pixels; half of it is the central difference's.
  const float reach = 0.5F * pair.windows / kHalf;
  auto& [xx, xy, yy, rx, ry] = columns_;
  add_terms(half_.width, compared.mean[(y - 1) % 3], compared.mean[y % 3], compared.mean[(y + 1) % 3],
            compared.difference[y % 3], pair.weight * reach * reach, -pair.weight * reach, xx.data(),
            xy.data(), yy.data(), rx.data(), ry.data());
}

void MotionEstimator::end_cells(int cell_row) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    float* const sums = sums_[i][cell_row];
    for (std::size_t x = 0; x < columns_[i].size(); ++x) sums[column_cells_[x]] += columns_[i][x];
    std::fill(columns_[i].begin(), columns_[i].end(), 0.0F);
  }
}

void MotionEstimator::step(MotionField& field) {
  const cv::Mat1f mean_x = mean_of_neighbours(field.x);
  const cv::Mat1f mean_y = mean_of_neighbours(field.y);
  const auto reg = static_cast<float>(options_.regularisation);
  const auto& [xx, xy, yy, rx, ry] = sums_;
  for (int i = 0; i < static_cast<int>(field.x.total()); ++i) {
    const float a = xx(i) + reg;
    const float b = xy(i);
    const float d = yy(i) + reg;
    const float x = rx(i) + reg * (mean_x(i) - field.x(i));
    const float y = ry(i) + reg * (mean_y(i) - field.y(i));
    const float determinant = a * d - b * b;
    field.x(i) = std::clamp(field.x(i) + (d * x - b * y) / determinant, -kLargest_px, kLargest_px);
    field.y(i) = std::clamp(field.y(i) + (a * y - b * x) / determinant, -kLargest_px, kLargest_px);
  }
}

}  // namespace esi
