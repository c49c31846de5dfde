#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// A smooth pattern without end: waves of random direction and phase, none shorter than `shortest_px`.
class Waves {
 public:
  Waves(unsigned seed, double shortest_px, double longest_px) {
    std::mt19937 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    for (int i = 0; i < 24; ++i) {
      const double length_px = shortest_px * std::pow(longest_px / shortest_px, uniform());
      const double angle = 2.0 * CV_PI * uniform();
      const double k = 2.0 * CV_PI / length_px;
      waves_.push_back({k * std::cos(angle), k * std::sin(angle), 2.0 * CV_PI * uniform()});
    }
  }

  double at(double x, double y) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.kx * x + wave.ky * y + wave.phase);
    return sum / std::sqrt(0.5 * static_cast<double>(waves_.size()));
  }

  double at(cv::Point2d point) const { return at(point.x, point.y); }

 private:
  struct Wave {
    double kx, ky, phase;
  };
  std::vector<Wave> waves_;
};

/// `of(x, y)` at every pixel.
template <class Function>
cv::Mat1f image_of(cv::Size size, Function of) {
  cv::Mat1f image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) image(y, x) = static_cast<float>(of(x, y));
  }
  return image;
}

/// Events of an ideal camera that sees log intensity `of(x, y, t_s)` from begin to end, each of `threshold`;
/// looked at every `step_us`. Sorted by time.
template <class Function>
std::vector<Event> events_of(SensorSize size, std::int64_t begin_us, std::int64_t end_us, double threshold,
                             Function of, std::int64_t step_us = 1000) {
  std::vector<Event> events;
  cv::Mat1d memory(size.height_px, size.width_px);
  for (std::int64_t t_us = begin_us; t_us < end_us; t_us += step_us) {
    const double t_s = 1e-6 * static_cast<double>(t_us);
    for (int y = 0; y < size.height_px; ++y) {
      for (int x = 0; x < size.width_px; ++x) {
        double& seen = memory(y, x);
        const double now = of(x, y, t_s);
        if (t_us == begin_us) seen = now;
        for (; std::abs(now - seen) >= threshold; seen += now > seen ? threshold : -threshold) {
          events.push_back({t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), now > seen});
        }
      }
    }
  }
  return events;
}

/// Of two images, leaving `margin_px` out all around.
inline double correlation(const cv::Mat1f& a, const cv::Mat1f& b, int margin_px = 0) {
  const cv::Rect inner(margin_px, margin_px, a.cols - 2 * margin_px, a.rows - 2 * margin_px);
  cv::Mat1d u, v;
  a(inner).convertTo(u, CV_64F, 1.0, -cv::mean(a(inner))[0]);
  b(inner).convertTo(v, CV_64F, 1.0, -cv::mean(b(inner))[0]);
  return u.dot(v) / std::sqrt(u.dot(u) * v.dot(v));
}

}  // namespace esi::test
