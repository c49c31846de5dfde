#include "esi/core/pose.hpp"

#include <algorithm>
#include <cmath>

namespace esi {

Quaternion normalized(const Quaternion& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x / norm, q.y / norm, q.z / norm, q.w / norm};
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Quaternion slerp(const Quaternion& from, const Quaternion& to, double share) {
  const double dot = from.x * to.x + from.y * to.y + from.z * to.z + from.w * to.w;
  const double sign = dot < 0.0 ? -1.0 : 1.0;  // q and -q are one rotation: take the shorter way
  const double angle = std::acos(std::min(std::abs(dot), 1.0));
  const bool near = angle < 1e-6;
  const double a = near ? 1.0 - share : std::sin((1.0 - share) * angle) / std::sin(angle);
  const double b = sign * (near ? share : std::sin(share * angle) / std::sin(angle));
  return normalized(
      {a * from.x + b * to.x, a * from.y + b * to.y, a * from.z + b * to.z, a * from.w + b * to.w});
}

Quaternion quaternion_of(const cv::Matx33d& r) {
  // Shepperd 1978: start from the largest of the four, so that nothing is divided by a small number.
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  const double largest = std::max({trace, r(0, 0), r(1, 1), r(2, 2)});
  Quaternion q;
  if (largest == trace) {
    q = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), 1.0 + trace};
  } else if (largest == r(0, 0)) {
    q = {1.0 + 2.0 * r(0, 0) - trace, r(0, 1) + r(1, 0), r(0, 2) + r(2, 0), r(2, 1) - r(1, 2)};
  } else if (largest == r(1, 1)) {
    q = {r(0, 1) + r(1, 0), 1.0 + 2.0 * r(1, 1) - trace, r(1, 2) + r(2, 1), r(0, 2) - r(2, 0)};
  } else {
    q = {r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), 1.0 + 2.0 * r(2, 2) - trace, r(1, 0) - r(0, 1)};
  }
  return normalized(q);
}

cv::Matx33d rotation_of(const Quaternion& q) {
  return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.z * q.w),     2 * (q.x * q.z + q.y * q.w),
          2 * (q.x * q.y + q.z * q.w),     1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.x * q.w),
          2 * (q.x * q.z - q.y * q.w),     2 * (q.y * q.z + q.x * q.w),     1 - 2 * (q.x * q.x + q.y * q.y)};
}

Quaternion quaternion_about(const cv::Vec3d& v) {
  const double angle = std::sqrt(v.dot(v));
  if (angle < 1e-12) return {};
  const double s = std::sin(angle / 2) / angle;
  return {s * v[0], s * v[1], s * v[2], std::cos(angle / 2)};
}

cv::Matx33d rotation_about(const cv::Vec3d& v) { return rotation_of(quaternion_about(v)); }

}  // namespace esi
