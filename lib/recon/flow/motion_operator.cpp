#include "esi/recon/flow/motion_operator.hpp"

#include <algorithm>

#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/simd.hpp"

namespace esi {
namespace {

/// Equation (6) for pixels that have a left and a right neighbour; outside the image, one above or below is
/// the pixel itself. A's part is that of equation (7)'s derivative, sorted by neighbours.
ESI_SIMD void product_row(int begin, int end, const float* __restrict above, const float* __restrict here,
                          const float* __restrict below, const float* __restrict above_dd,
                          const float* __restrict above_de, const float* __restrict above_ee,
                          const float* __restrict below_dd, const float* __restrict below_de,
                          const float* __restrict below_ee, float eps, float mu, float* __restrict out) {
  for (int x = begin; x < end; ++x) {
    const float left = here[x - 1];
    const float right = here[x + 1];
    const float along_d = below_dd[x] * (below[x + 1] - here[x]) + above_dd[x - 1] * (above[x - 1] - here[x]);
    const float along_e = above_ee[x] * (above[x + 1] - here[x]) + below_ee[x - 1] * (below[x - 1] - here[x]);
    const float mixed = (below_de[x] * (right - below[x]) + above_de[x - 1] * (left - above[x])) +
                        (above_de[x] * (right - above[x]) + below_de[x - 1] * (left - below[x]));
    const float laplacian = (left + right) + (above[x] + below[x]) - 4.0F * here[x];
    out[x] = mu * here[x] - ((along_d + along_e) + mixed) - eps * laplacian;
  }
}

/// For pixels that have a left and a right neighbour; `own` is what isn't of A.
ESI_SIMD void inverse_diagonal_between(int begin, int end, const float* __restrict above_dd,
                                       const float* __restrict above_ee, const float* __restrict below_dd,
                                       const float* __restrict below_ee, float own, float* __restrict out) {
  for (int x = begin; x < end; ++x)
    out[x] = 1.0F / (own + ((below_dd[x] + above_dd[x - 1]) + (above_ee[x] + below_ee[x - 1])));
}

/// [1 2 1] / 4 across rows.
ESI_SIMD void mix_rows(int cols, const float* __restrict a, const float* __restrict b,
                       const float* __restrict c, float* __restrict out) {
  for (int x = 0; x < cols; ++x) out[x] = 0.25F * (a[x] + c[x]) + 0.5F * b[x];
}

/// The same along a row, at every second corner.
ESI_SIMD void mix_along(int corners, const float* __restrict line, float* __restrict out) {
  for (int x = 0; x < corners; ++x) {
    const int i = 2 * x;
    out[x] = 0.25F * (line[i] + line[i + 2]) + 0.5F * line[i + 1];
  }
}

}  // namespace

MotionOperator::MotionOperator(cv::Size size) : dd(size, 0.0F), de(size, 0.0F), ee(size, 0.0F) {}

double MotionOperator::apply(const cv::Mat1f& in, cv::Mat1f& out) const {
  out.create(in.size());
  double product = 0.0;
  for (int y = 0; y < in.rows; ++y) {
    apply_row(in, y, out[y]);
    product += dot(in[y], out[y], in.cols);
  }
  return product;
}

void MotionOperator::apply_row(const cv::Mat1f& in, int y, float* out) const {
  const int last = dd.cols - 1;
  const float* const here = in[y];
  const float* const above = in[std::max(y - 1, 0)];
  const float* const below = in[std::min(y + 1, dd.rows - 1)];
  const int corner = corner_above(y);
  product_row(1, last, above, here, below, dd[corner], de[corner], ee[corner], dd[y], de[y], ee[y], eps, mu,
              out);
  // The first and the last pixel are their own neighbours outside, where there are no corners.
  const auto border = [&](int x, float beside, float from_corners) {
    const float laplacian = beside + above[x] + below[x] - 3.0F * here[x];
    out[x] = mu * here[x] - from_corners - eps * laplacian;
  };
  if (last == 0) {
    border(0, here[0], 0.0F);
    return;
  }
  border(0, here[1],
         (dd(y, 0) * (below[1] - here[0]) + ee(corner, 0) * (above[1] - here[0])) +
             (de(y, 0) * (here[1] - below[0]) + de(corner, 0) * (here[1] - above[0])));
  const int x = last - 1;
  border(last, here[x],
         (dd(corner, x) * (above[x] - here[last]) + ee(y, x) * (below[x] - here[last])) +
             (de(corner, x) * (here[x] - above[last]) + de(y, x) * (here[x] - below[last])));
}

void MotionOperator::inverse_diagonal_row(int y, float* out) const {
  const int above = corner_above(y);
  const int last = dd.cols - 1;
  const int vertical = (y > 0 ? 1 : 0) + (y + 1 < dd.rows ? 1 : 0);
  const auto own = [&](int neighbours) { return mu + eps * static_cast<float>(neighbours); };
  inverse_diagonal_between(1, last, dd[above], ee[above], dd[y], ee[y], own(vertical + 2), out);
  const int beside = last > 0 ? 1 : 0;
  out[0] = 1.0F / (own(vertical + beside) + (dd(y, 0) + ee(above, 0)));
  if (last > 0) out[last] = 1.0F / (own(vertical + 1) + (dd(above, last - 1) + ee(y, last - 1)));
}

void MotionOperator::coarsen(MotionOperator& coarse, const RowTeam& team) const {
  coarse.eps = eps;
  coarse.mu = 4.0F * mu;
  team.over_rows(coarse.size(), [&](int begin, int end) {
    std::vector<float> line(static_cast<std::size_t>(dd.cols));
    for (int y = begin; y < end; ++y) coarsen_row(y, line, coarse);
  });
}

void MotionOperator::coarsen_row(int y, std::vector<float>& line, MotionOperator& coarse) const {
  // Corner (X, Y) of the half resolution lies on corner (2 X + 1, 2 Y + 1). The last row stays 0.
  if (y + 1 >= coarse.dd.rows) return;
  const auto halve = [&](const cv::Mat1f& a, cv::Mat1f& half) {
    mix_rows(dd.cols, a[2 * y], a[2 * y + 1], a[2 * y + 2], line.data());
    mix_along(half.cols - 1, line.data(), half[y]);
  };
  halve(dd, coarse.dd);
  halve(de, coarse.de);
  halve(ee, coarse.ee);
}

}  // namespace esi
