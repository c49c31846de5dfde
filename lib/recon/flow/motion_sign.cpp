#include "esi/recon/flow/motion_sign.hpp"

#include <cmath>
#include <opencv2/core.hpp>

#include "esi/recon/flow/cell_smoothing.hpp"
#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/row_motion.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// Half of what is piled up is forgotten over this path, of the full resolution. Longer than that of the
/// image, which can follow a wrong motion for a pixel.
constexpr float kMemory_px = 6.0F;
/// Equation (12). Noise alone makes about half of this.
constexpr float kClearlyMore = 0.1F;
/// A window. What is faster shows its direction from one window to the next.
constexpr float kSlow_px = 1.0F;

/// Equation (11), v in px of the half resolution; x and y hold what came with the motion. `energy` is what is
/// in them then.
ESI_SIMD void pile_up(int cols, const float* __restrict vx, const float* __restrict vy,
                      const float* __restrict events, float* __restrict x, float* __restrict y,
                      float* __restrict energy) {
  for (int i = 0; i < cols; ++i) {
    const float length_px = kHalf * std::sqrt(vx[i] * vx[i] + vy[i] * vy[i]);
    const float lambda = 1.0F / (1.0F + length_px / kMemory_px);
    x[i] = lambda * x[i] - kHalf * vx[i] * events[i];
    y[i] = lambda * y[i] - kHalf * vy[i] * events[i];
    energy[i] = x[i] * x[i] + y[i] * y[i];
  }
}

std::array<cv::Mat1f, 2> zeros(cv::Size size) { return {cv::Mat1f(size, 0.0F), cv::Mat1f(size, 0.0F)}; }

void smooth_twice(cv::Mat1f& cells) {
  smooth_cells(cells);
  smooth_cells(cells);
}

/// Cells that are marked 1, and their neighbours as long as they are marked 2.
cv::Mat1b grown(const cv::Mat1b& marks) {
  cv::Mat1b reached(marks.size(), 0);
  std::vector<cv::Point> front;
  const auto reach = [&](cv::Point cell) {
    reached(cell) = 1;
    front.push_back(cell);
  };
  for (int y = 0; y < marks.rows; ++y)
    for (int x = 0; x < marks.cols; ++x)
      if (marks(y, x) == 1) reach({x, y});
  const cv::Rect grid({}, marks.size());
  while (!front.empty()) {
    const cv::Point cell = front.back();
    front.pop_back();
    for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = cell + step;
      if (grid.contains(next) && marks(next) != 0 && reached(next) == 0) reach(next);
    }
  }
  return reached;
}

}  // namespace

/// What a thread needs for the rows that it takes.
struct MotionSign::Rows {
  Rows(cv::Size half, const CellGrid& cells) : motion(half, cells), energy(motion.x.size()) {}

  RowMotion motion;
  std::vector<float> energy;
};

MotionSign::MotionSign(cv::Size half, const CellGrid& cells)
    : cells_(cells),
      along_(zeros(half)),
      against_(zeros(half)),
      moved_along_(zeros(half)),
      moved_against_(zeros(half)),
      along_rows_(half.height, cells.size().width),
      against_rows_(half.height, cells.size().width),
      along_energy_(cells.size(), 0.0F),
      against_energy_(cells.size(), 0.0F) {
  for (int x = 0; x < half.width; ++x) column_cells_.push_back(cells_.cell_of(x));
}

void MotionSign::take(const cv::Mat1f& events, const MotionField& field, const RowTeam& team) {
  team.over_rows(events.size(), [&](int begin, int end) {
    Rows rows(events.size(), cells_);
    for (int y = begin; y < end; ++y) take_row(events, field, y, rows);
  });
  std::swap(along_, moved_along_);
  std::swap(against_, moved_against_);
  sum_cells();
}

void MotionSign::take_row(const cv::Mat1f& events, const MotionField& field, int y, Rows& rows) {
  RowMotion& motion = rows.motion;
  motion.look_up(field, y, 1.0F / kHalf);
  const auto pile = [&](const Pile& last, Pile& moved, float* sums) {
    motion.lookup.sample(last[0], moved[0][y]);
    motion.lookup.sample(last[1], moved[1][y]);
    pile_up(events.cols, motion.x.data(), motion.y.data(), events[y], moved[0][y], moved[1][y],
            rows.energy.data());
    std::fill(sums, sums + cells_.size().width, 0.0F);
    for (std::size_t x = 0; x < rows.energy.size(); ++x) sums[column_cells_[x]] += rows.energy[x];
  };
  pile(along_, moved_along_, along_rows_[y]);
  motion.lookup.place(y, motion.x.data(), motion.y.data(), -1.0F);
  pile(against_, moved_against_, against_rows_[y]);
}

void MotionSign::sum_cells() {
  along_energy_.setTo(0.0F);
  against_energy_.setTo(0.0F);
  for (int y = 0; y < along_rows_.rows; ++y) {
    along_energy_.row(cells_.cell_of(y)) += along_rows_.row(y);
    against_energy_.row(cells_.cell_of(y)) += against_rows_.row(y);
  }
  smooth_twice(along_energy_);
  smooth_twice(against_energy_);
}

cv::Mat1f MotionSign::signs(const MotionField& field) const {
  cv::Mat1b marks(field.x.size(), 0);
  bool any = false;
  for (int i = 0; i < static_cast<int>(marks.total()); ++i) {
    const float more = against_energy_(i) - along_energy_(i);
    const float speed2 = field.x(i) * field.x(i) + field.y(i) * field.y(i);
    if (more <= 0.0F || speed2 >= kSlow_px * kSlow_px) continue;
    const bool clearly = more > kClearlyMore * (against_energy_(i) + along_energy_(i));
    marks(i) = clearly ? 1 : 2;
    any |= clearly;
  }
  if (!any) return {};
  cv::Mat1f signs(marks.size(), 1.0F);
  signs.setTo(-1.0F, grown(marks));
  return signs;
}

void MotionSign::turn(const cv::Mat1f& signs) {
  std::vector<float> sign(column_cells_.size());
  for (int y = 0; y < along_[0].rows; ++y) {
    cells_.interpolate_row(signs, y, 1.0F, sign.data());
    for (int x = 0; x < along_[0].cols; ++x) {
      if (sign[static_cast<std::size_t>(x)] >= 0.0F) continue;
      for (std::size_t i = 0; i < along_.size(); ++i) {
        std::swap(along_[i](y, x), against_[i](y, x));
        along_[i](y, x) *= -1.0F;
        against_[i](y, x) *= -1.0F;
      }
    }
  }
}

}  // namespace esi
