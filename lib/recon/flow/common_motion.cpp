#include "esi/recon/flow/common_motion.hpp"

#include <algorithm>
#include <vector>

#include "esi/recon/flow/small_system.hpp"

namespace esi {
namespace {

/// 1, x, y of a place: the three by which each component of the motion goes.
using Place = std::array<double, 3>;
constexpr int kTerms = 3;
constexpr std::size_t kUnknowns = 6;

Place place_of(int x, int y, cv::Size grid) {
  const double middle_x = 0.5 * (grid.width - 1);
  const double middle_y = 0.5 * (grid.height - 1);
  const double unit = std::max(middle_x, 1.0);
  return {1.0, (x - middle_x) / unit, (y - middle_y) / unit};
}

/// The normal equations; the unknowns are those of x, then those of y.
struct Normal {
  /// |p|^2 and |P|^2, to begin with.
  cv::Mat1d matrix{cv::Mat1d::eye(2 * kTerms, 2 * kTerms)};
  std::vector<double> rhs = std::vector<double>(kUnknowns, 0.0);

  void add(const Place& place, double xx, double xy, double yy, double x, double y) {
    for (int i = 0; i < kTerms; ++i) {
      const auto own = static_cast<std::size_t>(i);
      rhs[own] += place[own] * x;
      rhs[own + kTerms] += place[own] * y;
      for (int j = 0; j < kTerms; ++j) {
        const double both = place[own] * place[static_cast<std::size_t>(j)];
        matrix(i, j) += both * xx;
        matrix(i, j + kTerms) += both * xy;
        matrix(i + kTerms, j) += both * xy;
        matrix(i + kTerms, j + kTerms) += both * yy;
      }
    }
  }
};

}  // namespace

void add_common_motion(const CellSums& sums, MotionField& field) {
  const cv::Size grid = field.x.size();
  const auto& [xx, xy, yy, rx, ry] = sums;
  Normal normal;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x)
      normal.add(place_of(x, y, grid), xx(y, x), xy(y, x), yy(y, x), rx(y, x), ry(y, x));
  }
  const std::vector<double> motion = solve_small(normal.matrix, normal.rhs);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Place place = place_of(x, y, grid);
      field.x(y, x) += static_cast<float>(motion[0] + motion[1] * place[1] + motion[2] * place[2]);
      field.y(y, x) += static_cast<float>(motion[3] + motion[4] * place[1] + motion[5] * place[2]);
    }
  }
}

}  // namespace esi
