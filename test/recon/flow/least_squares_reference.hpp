#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "esi/recon/flow/motion_operator.hpp"

namespace esi::test {

/// The least-squares problem of esi-flow, slowly, in double precision, and from its energy: nothing is shared
/// with MotionOperator but the numbers of A.
///   E(L) = sum over corners  grad L^T A grad L  +  eps sum over neighbours (L_i - L_j)^2  +  mu sum L^2
class LeastSquaresReference {
 public:
  explicit LeastSquaresReference(const MotionOperator& of)
      : size_(of.size()), eps_(of.eps), mu_(of.mu), xx_(size_), xy_(size_), yy_(size_) {
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) {
        // dd D^2 + 2 de D E + ee E^2 with D = gx + gy, E = gx - gy
        const double dd = of.dd(y, x), de = of.de(y, x), ee = of.ee(y, x);
        xx_(y, x) = dd + 2.0 * de + ee;
        xy_(y, x) = dd - ee;
        yy_(y, x) = dd - 2.0 * de + ee;
      }
    }
  }

  cv::Size size() const { return size_; }

  /// Half the gradient of E at L: M L.
  cv::Mat1d apply(const cv::Mat1d& l) const {
    cv::Mat1d out(size_, 0.0);
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) {
        out(y, x) += mu_ * l(y, x);
        if (x + 1 < size_.width) pull(out, l, {x, y}, {x + 1, y});
        if (y + 1 < size_.height) pull(out, l, {x, y}, {x, y + 1});
        if (x + 1 < size_.width && y + 1 < size_.height) add_corner(out, l, x, y);
      }
    }
    return out;
  }

  /// Plain conjugate gradients until the residual is 1e-12 of rhs.
  cv::Mat1d solve(const cv::Mat1d& rhs) const {
    cv::Mat1d solution(size_, 0.0);
    cv::Mat1d residual = rhs.clone();
    cv::Mat1d direction = residual.clone();
    double remaining = residual.dot(residual);
    const double enough = 1e-24 * rhs.dot(rhs);
    while (remaining > enough) {
      const cv::Mat1d product = apply(direction);
      const double step = remaining / direction.dot(product);
      solution += step * direction;
      residual -= step * product;
      const double next = residual.dot(residual);
      direction = residual + (next / remaining) * direction;
      remaining = next;
    }
    return solution;
  }

  /// |rhs - M L| / |rhs|
  double relative_residual(const cv::Mat1f& l, const cv::Mat1f& rhs) const {
    cv::Mat1d exact_l, exact_rhs;
    l.convertTo(exact_l, CV_64F);
    rhs.convertTo(exact_rhs, CV_64F);
    return cv::norm(exact_rhs, apply(exact_l), cv::NORM_L2) / cv::norm(exact_rhs, cv::NORM_L2);
  }

 private:
  void pull(cv::Mat1d& out, const cv::Mat1d& l, cv::Point a, cv::Point b) const {
    const double pull = eps_ * (l(a) - l(b));
    out(a) += pull;
    out(b) -= pull;
  }

  void add_corner(cv::Mat1d& out, const cv::Mat1d& l, int x, int y) const {
    const double gx = 0.5 * (l(y, x + 1) - l(y, x) + l(y + 1, x + 1) - l(y + 1, x));
    const double gy = 0.5 * (l(y + 1, x) - l(y, x) + l(y + 1, x + 1) - l(y, x + 1));
    const double fx = 0.5 * (xx_(y, x) * gx + xy_(y, x) * gy);
    const double fy = 0.5 * (xy_(y, x) * gx + yy_(y, x) * gy);
    out(y, x) += -fx - fy;
    out(y, x + 1) += fx - fy;
    out(y + 1, x) += -fx + fy;
    out(y + 1, x + 1) += fx + fy;
  }

  cv::Size size_;
  double eps_, mu_;
  cv::Mat1d xx_, xy_, yy_;
};

}  // namespace esi::test
