#include "esi/sim/step_plan.hpp"

#include <algorithm>
#include <utility>

namespace esi {
namespace {

/// Beyond that no light could be followed; it bounds the work where a list of poses jumps.
constexpr std::int64_t kShortestStep_us = 10;

}  // namespace

void TimeStepOptions::declare(OptionTable& table) {
  table.integer("step_us", step_us, {kShortestStep_us, 1000}, "us", "longest step of the simulation");
  table.real("max_motion_px", max_motion_px, {0.01, 0.5}, "px",
             "longest way of the image in one step; steps get shorter where it moves faster");
}

StepPlanner::StepPlanner(const TimeStepOptions& options, const Scenario& scenario)
    : options_(options), scenario_(&scenario), view_(scenario.view(0)) {}

std::vector<PlannedStep> StepPlanner::plan(std::int64_t end_us) {
  std::vector<PlannedStep> steps;
  while (t_us_ < end_us) {
    // Steps end at multiples of step_us, wherever plans end.
    const std::int64_t step_end_us = std::min(end_us, (t_us_ / options_.step_us + 1) * options_.step_us);
    go_to(step_end_us, scenario_->view(step_end_us), steps);
  }
  return steps;
}

void StepPlanner::go_to(std::int64_t end_us, View at_end, std::vector<PlannedStep>& steps) {
  const std::int64_t duration_us = end_us - t_us_;
  const double motion_px = largest_motion_px(view_, at_end, scenario_->camera().size);
  if (motion_px > options_.max_motion_px && duration_us >= 2 * kShortestStep_us) {
    const std::int64_t middle_us = t_us_ + duration_us / 2;
    go_to(middle_us, scenario_->view(middle_us), steps);
    return go_to(end_us, std::move(at_end), steps);
  }
  view_ = std::move(at_end);
  steps.push_back({{static_cast<std::int32_t>(t_us_), static_cast<std::int32_t>(end_us)}, view_});
  t_us_ = end_us;
}

}  // namespace esi
