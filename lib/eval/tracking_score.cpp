#include <algorithm>
#include <cmath>

#include "esi/eval/tracking.hpp"

namespace esi {
namespace {

/// Collects a phase's frames. Times are since its begin.
class TrackingTally {
 public:
  void add(std::int64_t t_us, bool is_available, std::optional<double> error_m) {
    ++available_.of;
    if (!is_available) return;
    ++available_.hits;
    longest_gap_us_ = std::max(longest_gap_us_, t_us - latest_us_);
    latest_us_ = t_us;
    if (error_m) errors_m_.push_back(*error_m);
  }

  PhaseTracking score(const std::string& name, std::int64_t duration_us) const {
    PhaseTracking score;
    score.name = name;
    score.available = available_;
    score.longest_gap_us = std::max(longest_gap_us_, duration_us - latest_us_);
    if (available_.of == 0) score.reason = "no frame lies in this phase";
    if (errors_m_.empty()) return score;
    double squares = 0.0;
    for (const double error : errors_m_) squares += error * error;
    score.rmse_m = std::sqrt(squares / static_cast<double>(errors_m_.size()));
    score.error_median_m = median(errors_m_);
    score.error_max_m = *std::max_element(errors_m_.begin(), errors_m_.end());
    return score;
  }

 private:
  Rate available_;
  std::vector<double> errors_m_;
  std::int64_t latest_us_ = 0, longest_gap_us_ = 0;
};

}  // namespace

TrackingScore score_tracking(std::span<const Phase> phases, const TrackingRun& run,
                             const PoseTrack& true_camera, const PoseTrack& true_target,
                             const TrackingOptions& options) {
  TrackingScore result;
  TrackingTally total;
  std::int64_t before_us = 0;  // the total's clock stands still between phases
  for (const Phase& phase : phases) {
    TrackingTally tally;
    for (const TrackedFrame& frame : run.frames) {
      if (!phase.interval.contains(frame.t_us)) continue;
      const bool is_available =
          frame.relative_m && static_cast<double>(frame.age_us) <= options.max_age_s * 1e6;
      const auto camera = true_camera.at(frame.t_us), target = true_target.at(frame.t_us);
      std::optional<double> error_m;
      if (is_available && camera && target) {
        error_m = cv::norm(*frame.relative_m - (target->position_m - camera->position_m));
      }
      const std::int64_t since_begin_us = frame.t_us - phase.interval.begin_us;
      tally.add(since_begin_us, is_available, error_m);
      total.add(before_us + since_begin_us, is_available, error_m);
    }
    result.phases.push_back(tally.score(phase.name, phase.interval.duration_us()));
    before_us += phase.interval.duration_us();
  }
  result.total = total.score("total", before_us);
  if (!result.total.reason.empty()) result.total.reason = "no frame lies in any phase";
  return result;
}

}  // namespace esi
