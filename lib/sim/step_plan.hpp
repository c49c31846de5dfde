#pragma once

#include <cstdint>
#include <vector>

#include "esi/core/options.hpp"
#include "esi/sim/scenario.hpp"
#include "esi/sim/sensor_event.hpp"

namespace esi {

/// How finely time is cut.
struct TimeStepOptions {
  std::int64_t step_us = 1000;
  double max_motion_px = 0.5;

  void declare(OptionTable& table);
};

/// A step of the simulation, and what is seen at its end.
struct PlannedStep {
  TimeStep time;
  View view;
};

/// Cuts time into steps, short enough that the image hardly moves within one.
class StepPlanner {
 public:
  StepPlanner(const TimeStepOptions& options, const Scenario& scenario);

  /// What is seen where the next plan begins.
  const View& view() const { return view_; }

  /// The steps from the last plan's end to end_us.
  std::vector<PlannedStep> plan(std::int64_t end_us);

 private:
  /// Halves the way until its parts are short enough.
  void go_to(std::int64_t end_us, View at_end, std::vector<PlannedStep>& steps);

  TimeStepOptions options_;
  const Scenario* scenario_;
  std::int64_t t_us_ = 0;
  View view_;
};

}  // namespace esi
