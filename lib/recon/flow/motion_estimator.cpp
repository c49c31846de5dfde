#include "esi/recon/flow/motion_estimator.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "esi/recon/flow/cell_smoothing.hpp"
#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/row_motion.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// Of a window's motion: nothing that is faster can be followed.
constexpr float kLargest_px = 64.0F;
/// Of an equation (2a) that knows one direction only, to the rounding of floats: without hold there may be.
constexpr float kSingular = 1e-6F;
/// Factors by which a window's speed is corrected at most.
constexpr double kSlowest = 0.8;
constexpr double kFastest = 1.25;

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

/// Half of T's mean trace.
float mean_texture(const cv::Mat1f& xx, const cv::Mat1f& yy) {
  double sum = 0.0;
  for (int i = 0; i < static_cast<int>(xx.total()); ++i)
    sum += static_cast<double>(xx(i)) + static_cast<double>(yy(i));
  return static_cast<float>(0.5 * sum / static_cast<double>(xx.total()));
}

void take_median(cv::Mat1f& cells) {
  cv::Mat1f medians;
  cv::medianBlur(cells, medians, 3);
  cells = medians;
}

}  // namespace

/// The latest three rows of a pair after compensation, row y at y % 3.
struct MotionEstimator::Compared {
  cv::Mat1f mean, difference;
};

/// What is needed while rows are gone over.
struct MotionEstimator::Strip {
  Strip(cv::Size half, const CellGrid& cells, std::size_t pairs)
      : motion(half, cells), moved(motion.x.size()) {
    for (auto& column : columns) column.resize(moved.size());
    for (std::size_t i = 0; i < pairs; ++i)
      compared.push_back({cv::Mat1f(3, half.width), cv::Mat1f(3, half.width)});
  }

  RowMotion motion;
  std::vector<float> moved;
  std::vector<Compared> compared;
  std::array<std::vector<float>, 5> columns;  ///< the sums of one row of cells, by pixel column
};

MotionEstimator::MotionEstimator(cv::Size full, const Options& options)
    : options_(options), half_(half_of(full)), cells_(half_, options.cell_px / static_cast<double>(kHalf)) {
  for (cv::Mat1f& sum : sums_) sum.create(cells_.size());
  for (int x = 0; x < half_.width; ++x) column_cells_.push_back(cells_.cell_of(x));
  for (int y = 0; y < half_.height; ++y)
    if (y == 0 || cells_.cell_of(y) != cells_.cell_of(y - 1)) cell_begins_.push_back(y);
  cell_begins_.push_back(half_.height);
}

void MotionEstimator::improve(std::span<const MovedPair> pairs, MotionField& field, const RowTeam& team) {
  add_terms_of(pairs, field, team);
  add_common_motion(sums_, field);
  for (int round = 0; round < options_.rounds; ++round) {
    add_terms_of(pairs, field, team);
    for (cv::Mat1f& sum : sums_) {
      smooth_cells(sum);
      smooth_cells(sum);
    }
    step(field);
  }
  take_median(field.x);
  take_median(field.y);
}

void MotionEstimator::correct_speed(const MovedPair& pair, MotionField& field, const RowTeam& team) {
  add_terms_of({&pair, 1}, field, team);
  const auto& [xx, xy, yy, rx, ry] = sums_;
  double along = 0.0;
  double energy = 1.0;
  for (int i = 0; i < static_cast<int>(field.x.total()); ++i) {
    const float x = field.x(i);
    const float y = field.y(i);
    along += static_cast<double>(x * rx(i) + y * ry(i));
    energy += static_cast<double>(x * x * xx(i) + 2.0F * x * y * xy(i) + y * y * yy(i));
  }
  const double factor = std::clamp(1.0 + 0.5 * along / energy, kSlowest, kFastest);
  field.x *= factor;
  field.y *= factor;
}

void MotionEstimator::add_terms_of(std::span<const MovedPair> pairs, const MotionField& field,
                                   const RowTeam& team) {
  for (cv::Mat1f& sum : sums_) sum.setTo(0.0F);
  const int cell_rows = static_cast<int>(cell_begins_.size()) - 1;
  const std::vector<int> cuts = team.cuts(cell_rows, static_cast<int>(half_.area()) / cell_rows, 1);
  team.each(static_cast<int>(cuts.size()) - 1, [&](int i) {
    const auto row_at = [&](int cut) {
      return cell_begins_[static_cast<std::size_t>(cuts[static_cast<std::size_t>(cut)])];
    };
    add_strip(pairs, field, row_at(i), row_at(i + 1));
  });
}

void MotionEstimator::add_strip(std::span<const MovedPair> pairs, const MotionField& field, int begin,
                                int end) {
  Strip strip(half_, cells_, pairs.size());
  const int first = std::max(begin, 1);
  const int last = std::min(end, half_.height - 1) - 1;
  for (int y = first - 1; y <= last + 1; ++y) {
    compensate_row(pairs, field, y, strip);
    const int middle = y - 1;
    if (middle < first) continue;
    for (std::size_t i = 0; i < pairs.size(); ++i) add_row(pairs[i], strip.compared[i], middle, strip);
    const int cell = cells_.cell_of(middle);
    if (middle == last || cells_.cell_of(y) != cell) end_cells(cell, strip);
  }
}

void MotionEstimator::compensate_row(std::span<const MovedPair> pairs, const MotionField& field, int y,
                                     Strip& strip) const {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const MovedPair& pair = pairs[i];
    if (i == 0 || pair.windows != pairs[i - 1].windows) strip.motion.look_up(field, y, pair.windows / kHalf);
    strip.motion.lookup.sample(pair.before, strip.moved.data());
    mean_and_difference(half_.width, strip.moved.data(), pair.after[y], strip.compared[i].mean[y % 3],
                        strip.compared[i].difference[y % 3]);
  }
}

void MotionEstimator::add_row(const MovedPair& pair, const Compared& compared, int y, Strip& strip) const {
  // A step of 1 px a window moves the pair by so many pixels; half of it is the central difference's.
  const float reach = 0.5F * pair.windows / kHalf;
  auto& [xx, xy, yy, rx, ry] = strip.columns;
  add_terms(half_.width, compared.mean[(y - 1) % 3], compared.mean[y % 3], compared.mean[(y + 1) % 3],
            compared.difference[y % 3], pair.weight * reach * reach, -pair.weight * reach, xx.data(),
            xy.data(), yy.data(), rx.data(), ry.data());
}

void MotionEstimator::end_cells(int cell_row, Strip& strip) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    std::vector<float>& columns = strip.columns[i];
    float* const sums = sums_[i][cell_row];
    for (std::size_t x = 0; x < columns.size(); ++x) sums[column_cells_[x]] += columns[x];
    std::fill(columns.begin(), columns.end(), 0.0F);
  }
}

void MotionEstimator::step(MotionField& field) {
  const cv::Mat1f mean_x = mean_of_neighbours(field.x);
  const cv::Mat1f mean_y = mean_of_neighbours(field.y);
  const auto reg = static_cast<float>(options_.regularisation);
  const auto& [xx, xy, yy, rx, ry] = sums_;
  const float own = reg + static_cast<float>(options_.hold) * mean_texture(xx, yy);
  for (int i = 0; i < static_cast<int>(field.x.total()); ++i) {
    const float a = xx(i) + own;
    const float b = xy(i);
    const float d = yy(i) + own;
    const float x = rx(i) + reg * (mean_x(i) - field.x(i));
    const float y = ry(i) + reg * (mean_y(i) - field.y(i));
    const float determinant = a * d - b * b;
    if (determinant <= kSingular * a * d) continue;
    field.x(i) = std::clamp(field.x(i) + (d * x - b * y) / determinant, -kLargest_px, kLargest_px);
    field.y(i) = std::clamp(field.y(i) + (a * y - b * x) / determinant, -kLargest_px, kLargest_px);
  }
}

}  // namespace esi
