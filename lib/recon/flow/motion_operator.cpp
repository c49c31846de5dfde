#include "esi/recon/flow/motion_operator.hpp"

#include <algorithm>

#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/row_sums.hpp"
#include "esi/recon/flow/simd.hpp"

namespace esi {
namespace {

ESI_SIMD void flux_row(int corners, const float* __restrict upper, const float* __restrict lower,
                       const float* __restrict dd, const float* __restrict de, const float* __restrict ee,
                       float* __restrict d, float* __restrict e) {
  for (int x = 0; x < corners; ++x) {
    const float along_d = lower[x + 1] - upper[x];
    const float along_e = upper[x + 1] - lower[x];
    d[x] = dd[x] * along_d + de[x] * along_e;
    e[x] = de[x] * along_d + ee[x] * along_e;
  }
}

/// For pixels that have a left and a right neighbour. Outside the image a neighbour is the pixel itself.
ESI_SIMD void divergence_row(int begin, int end, const float* __restrict above, const float* __restrict here,
                             const float* __restrict below, const float* __restrict above_d,
                             const float* __restrict above_e, const float* __restrict below_d,
                             const float* __restrict below_e, float eps, float mu, float* __restrict out) {
  for (int x = begin; x < end; ++x) {
    const float divergence = (below_d[x + 1] - above_d[x]) + (above_e[x + 1] - below_e[x]);
    const float laplacian = (here[x - 1] + here[x + 1]) + (above[x] + below[x]) - 4.0F * here[x];
    out[x] = mu * here[x] - divergence - eps * laplacian;
  }
}

ESI_SIMD void diagonal_row(int corners, const float* __restrict dd, const float* __restrict ee,
                           float* __restrict upper, float* __restrict lower) {
  for (int x = 0; x < corners; ++x) upper[x] += dd[x];
  for (int x = 0; x < corners; ++x) upper[x + 1] += ee[x];
  for (int x = 0; x < corners; ++x) lower[x] += ee[x];
  for (int x = 0; x < corners; ++x) lower[x + 1] += dd[x];
}

/// Corner X of the half resolution lies on corner 2 X + 1; the mean is of 3x3 around it, [1 2 1]/4 each way.
ESI_SIMD void halve_corners_row(int corners, const float* __restrict a, const float* __restrict b,
                                const float* __restrict c, float* __restrict out) {
  for (int x = 0; x < corners; ++x) {
    const int i = 2 * x;
    const float left = a[i] + 2.0F * b[i] + c[i];
    const float middle = a[i + 1] + 2.0F * b[i + 1] + c[i + 1];
    const float right = a[i + 2] + 2.0F * b[i + 2] + c[i + 2];
    out[x] = 0.0625F * (left + 2.0F * middle + right);
  }
}

void halve_corners(const cv::Mat1f& fine, cv::Mat1f& coarse) {
  coarse.row(coarse.rows - 1).setTo(0.0F);
  for (int y = 0; y + 1 < coarse.rows; ++y) {
    halve_corners_row(coarse.cols - 1, fine[2 * y], fine[2 * y + 1], fine[2 * y + 2], coarse[y]);
    coarse(y, coarse.cols - 1) = 0.0F;
  }
}

}  // namespace

MotionOperator::MotionOperator(cv::Size size) : dd(size, 0.0F), de(size, 0.0F), ee(size, 0.0F) {
  const auto entries = static_cast<std::size_t>(size.width) + 1;
  for (auto* row : {&above_d_, &above_e_, &below_d_, &below_e_}) row->resize(entries);
}

void MotionOperator::flux_of(const cv::Mat1f& in, int y, std::vector<float>& d, std::vector<float>& e) const {
  if (y + 1 >= in.rows) {
    std::fill(d.begin(), d.end(), 0.0F);
    std::fill(e.begin(), e.end(), 0.0F);
    return;
  }
  flux_row(in.cols - 1, in[y], in[y + 1], dd[y], de[y], ee[y], d.data() + 1, e.data() + 1);
}

double MotionOperator::apply(const cv::Mat1f& in, cv::Mat1f& out) {
  out.create(in.size());
  const int last = in.cols - 1;
  std::fill(above_d_.begin(), above_d_.end(), 0.0F);
  std::fill(above_e_.begin(), above_e_.end(), 0.0F);
  double product = 0.0;
  for (int y = 0; y < in.rows; ++y) {
    flux_of(in, y, below_d_, below_e_);
    const float* const here = in[y];
    const float* const above = in[std::max(y - 1, 0)];
    const float* const below = in[std::min(y + 1, in.rows - 1)];
    divergence_row(1, last, above, here, below, above_d_.data(), above_e_.data(), below_d_.data(),
                   below_e_.data(), eps, mu, out[y]);
    for (const int x : {0, last}) {
      const auto i = static_cast<std::size_t>(x);
      const float divergence = (below_d_[i + 1] - above_d_[i]) + (above_e_[i + 1] - below_e_[i]);
      const float beside = here[std::max(x - 1, 0)] + here[std::min(x + 1, last)];
      out(y, x) = mu * here[x] - divergence - eps * (beside + above[x] + below[x] - 4.0F * here[x]);
    }
    product += dot(here, out[y], in.cols);
    std::swap(above_d_, below_d_);
    std::swap(above_e_, below_e_);
  }
  return product;
}

void MotionOperator::invert_diagonal(cv::Mat1f& inverse) const {
  inverse.create(size());
  const int last_x = inverse.cols - 1;
  const int last_y = inverse.rows - 1;
  for (int y = 0; y <= last_y; ++y) {
    const int vertical = (y > 0 ? 1 : 0) + (y < last_y ? 1 : 0);
    for (int x = 0; x <= last_x; ++x) {
      const int neighbours = vertical + (x > 0 ? 1 : 0) + (x < last_x ? 1 : 0);
      inverse(y, x) = mu + eps * static_cast<float>(neighbours);
    }
  }
  for (int y = 0; y < last_y; ++y) diagonal_row(last_x, dd[y], ee[y], inverse[y], inverse[y + 1]);
  for (float& value : inverse) value = 1.0F / value;
}

void MotionOperator::coarsen(MotionOperator& coarse) const {
  halve_corners(dd, coarse.dd);
  halve_corners(de, coarse.de);
  halve_corners(ee, coarse.ee);
  coarse.eps = eps;
  coarse.mu = 4.0F * mu;
}

}  // namespace esi
