#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/time.hpp"

namespace esi::test {

/// Pan et al.'s double integral at one pixel, straight from its equation: E(f -> t) is counted anew for each
/// stretch between two events.
class EdiReference {
 public:
  struct Step {
    std::int64_t t_us;
    double p;
  };

  EdiReference(std::vector<Step> events, double c) : events_(std::move(events)), c_(c) {}

  /// Signed events from t = f to t, each half-open; negative for t < f.
  double count(std::int64_t f_us, std::int64_t t_us) const {
    double sum = 0.0;
    for (const Step& event : events_) {
      if (event.t_us >= f_us && event.t_us < t_us) sum += event.p;
      if (event.t_us >= t_us && event.t_us < f_us) sum -= event.p;
    }
    return sum;
  }

  /// The sharp intensity at f, from the blurred one.
  double sharp(double blurred, Interval exposure, std::int64_t f_us) const {
    if (exposure.is_empty()) return blurred;
    std::vector<std::int64_t> edges{exposure.begin_us, exposure.end_us};
    for (const Step& event : events_) {
      if (exposure.contains(event.t_us)) edges.push_back(event.t_us);
    }
    std::sort(edges.begin(), edges.end());
    double integral = 0.0;
    for (std::size_t i = 1; i < edges.size(); ++i) {
      // An event at the stretch's begin counts for all of it.
      const double e = count(f_us, edges[i - 1] + 1);
      if (edges[i] > edges[i - 1])
        integral += std::exp(c_ * e) * static_cast<double>(edges[i] - edges[i - 1]);
    }
    return blurred * static_cast<double>(exposure.duration_us()) / integral;
  }

  double carried_on(double sharp, std::int64_t f_us, std::int64_t t_us) const {
    return sharp * std::exp(c_ * count(f_us, t_us));
  }

 private:
  std::vector<Step> events_;
  double c_;
};

}  // namespace esi::test
