#include "esi/recon/flow/esi_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "esi/recon/flow/grey_levels.hpp"

namespace esi {
namespace {

/// Parameters are for windows of this length. Of another length, a window counts by its share of it.
constexpr double kReferenceWindow_us = 10'000.0;
/// So many windows' flow comes from sums of event images: there is no L yet.
constexpr std::int64_t kFirstWindows = 8;

cv::Size cv_size(SensorSize size) { return {size.width_px, size.height_px}; }

EventWindows windows_of(const EsiFlowOptions& options, SensorSize size) {
  if (options.window == EsiFlowOptions::Window::time) return EventWindows::of_duration(options.window_us);
  const double pixels = static_cast<double>(size.width_px) * size.height_px;
  const double events = std::max(options.events_per_pixel * pixels, 1.0);
  return EventWindows::of_count_within(static_cast<std::size_t>(events), options.window_us);
}

void add(const SmoothEvents& window, SmoothEvents& sum) {
  sum.image += window.image;
  sum.length += window.length;
}

/// How many times as long `now` is. Never more than 4 or less than a quarter: a few events of noise before
/// the image begins to move say nothing of how far it will.
double change(double before, double now) { return std::clamp(now / before, 0.25, 4.0); }

/// Of two sums in a row, the first made as strong as if it were as long as the second. The motion between
/// their middles is in units of that in a window of length `unit`.
MovedPair pair_of(SmoothEvents& before, const SmoothEvents& after, double weight, double unit) {
  const double times = change(before.length, after.length);
  if (times != 1.0) before.image *= times;
  const double apart = 0.5 * (1.0 / times + 1.0) * after.length;
  return {before.image, after.image, static_cast<float>(weight), static_cast<float>(apart / unit)};
}

}  // namespace

void EsiFlowOptions::declare(OptionTable& table) {
  table.choice("window", window, {"events", "time"},
               "what ends a window of events that are taken at once: their number, or the clock");
  table.real("events_per_pixel", events_per_pixel, {0.001, 20.0}, "", "a window's events for each pixel");
  table.integer("window_us", window_us, {1000, 1'000'000}, "us",
                "how long a window of time lasts, and at most one of events");
  table.toggle("balance", balance, "let ON and OFF events weigh by how rare they are: thresholds differ");
  table.real("flow_blur_px", flow_blur_px, {0.1, 20.0}, "px",
             "deviation of a Gaussian before motion is estimated, at half resolution");
  table.integer("cell_px", cell_px, {4, 256}, "px", "side of the cells that have a motion of their own");
  table.real("flow_regularisation", flow_regularisation, {1e-6, 1e6}, "",
             "how much a cell's motion is held by its neighbours'");
  table.real("event_pair_weight", event_pair_weight, {0.0, 1e6}, "",
             "how much two event images count for the motion, beside the reconstruction");
  table.real("flow_hold", flow_hold, {0.0, 1e6}, "",
             "how much a cell's motion stays as it was, but for what all cells share");
  table.integer("flow_rounds", flow_rounds, {1, 20}, "",
                "how often each cell's motion is improved in a window");
  table.real("memory", memory, {0.0, 1.0}, "", "what is left of the past after 10 ms without motion");
  table.real("memory_px", memory_px, {0.01, 1e6}, "px", "half of the past is forgotten over this path");
  table.real("eps", eps, {1e-6, 1e3}, "px^2", "smoothness of the image");
  table.real("mu", mu, {1e-9, 1e3}, "", "pull of the image towards mid-grey");
  table.integer("levels", levels, {1, 12}, "", "resolutions that are solved, each half of the one before");
  table.integer("steps_full", steps_full, {0, 1000}, "", "steps of the solver at full resolution");
  table.integer("steps_half", steps_half, {0, 1000}, "", "at half");
  table.integer("steps_coarse", steps_coarse, {0, 1000}, "", "at each below");
  table.integer("cycles", cycles, {1, 100}, "", "how often all levels are solved for a window");
  table.integer("first_cycles", first_cycles, {1, 100}, "", "the same in the first windows");
  table.integer("first_windows", first_windows, {0, 10'000}, "", "how many these are");
  table.real("contrast_deviations", contrast_deviations, {0.1, 100.0}, "",
             "so many deviations of the image are shown white");
}

BrightnessModel::Options EsiFlowOptions::model() const {
  return {.eps = static_cast<float>(eps),
          .mu = static_cast<float>(mu),
          .memory = memory,
          .memory_px = static_cast<float>(memory_px)};
}

MultilevelSolver::Options EsiFlowOptions::solver() const {
  std::vector<int> steps(static_cast<std::size_t>(levels), static_cast<int>(steps_coarse));
  steps[0] = static_cast<int>(steps_full);
  if (steps.size() > 1) steps[1] = static_cast<int>(steps_half);
  return {steps};
}

EsiFlow::EsiFlow(const EsiFlowOptions& options, SensorSize size)
    : options_(options),
      windows_(windows_of(options, size)),
      event_image_(size, options.balance),
      smooth_(options.flow_blur_px),
      motion_(cv_size(size), {static_cast<double>(options.cell_px), options.flow_regularisation,
                              options.flow_hold, static_cast<int>(options.flow_rounds)}),
      sign_(half_of(cv_size(size)), motion_.cells()),
      cells_(cv_size(size), static_cast<double>(options.cell_px)),
      model_(cv_size(size), options.model()),
      solver_(cv_size(size), options.solver()),
      field_{cv::Mat1f(motion_.cells().size(), 0.0F), cv::Mat1f(motion_.cells().size(), 0.0F)} {}

void EsiFlow::take(std::span<const Event> events, std::span<const float> weights) {
  windows_.add(events, weights, step());
}

EventWindows::Take EsiFlow::step() {
  return
      [this](std::span<const Event> window, std::span<const float> weights) { take_window(window, weights); };
}

void EsiFlow::take_window(std::span<const Event> window, std::span<const float> weights) {
  const auto shift = team_.begin_shift();
  const Interval now = *windows_.last();
  const auto duration_us = static_cast<double>(std::max<std::int64_t>(now.duration_us(), 1));
  const cv::Mat1f& b = event_image_.of(window, weights);
  smooth_(b, events_.image, team_);
  events_.length = length_of(window.size(), duration_us);
  if (last_window_) expect_motion(now);
  last_window_ = now;
  find_motion();
  events_.image.copyTo(events_before_.image);
  events_before_.length = events_.length;
  model_.take(b, duration_us / kReferenceWindow_us, field_, cells_, team_);
  model_.right_hand_side(rhs_, team_);
  const bool is_early = windows_seen_ < options_.first_windows;
  solver_.solve(
      model_.normal_operator(), rhs_,
      static_cast<int>(is_early ? std::max(options_.first_cycles, options_.cycles) : options_.cycles),
      model_.log_intensity(), team_);
  ++windows_seen_;
}

double EsiFlow::length_of(std::size_t events, double duration_us) const {
  return options_.window == EsiFlowOptions::Window::time ? duration_us : static_cast<double>(events);
}

void EsiFlow::expect_motion(const Interval& next) {
  if (next.begin_us != last_window_->end_us) {
    // Nothing has happened since: nothing moved.
    field_.x.setTo(0.0F);
    field_.y.setTo(0.0F);
    events_before_.image.setTo(0.0F);
    events_before_.length = events_.length;
    first_events_.clear();
    return;
  }
  const double times = change(events_before_.length, events_.length);
  if (times == 1.0) return;
  field_.x *= times;
  field_.y *= times;
}

void EsiFlow::find_motion() {
  const bool is_first = windows_seen_ < kFirstWindows;
  if (is_first) {
    estimate_first_motion();
  } else {
    estimate_motion();
  }
  sign_.take(events_.image, field_, team_);
  if (!is_first) turn_reversed_cells();
}

void EsiFlow::estimate_first_motion() {
  first_events_.push_back({events_.image.clone(), events_.length});
  const std::size_t half = first_events_.size() / 2;
  if (half == 0) return;
  SmoothEvents before{cv::Mat1f(events_.image.size(), 0.0F)};
  SmoothEvents after{cv::Mat1f(events_.image.size(), 0.0F)};
  const auto last = first_events_.end();
  for (std::size_t i = 1; i <= half; ++i) {
    add(*(last - static_cast<std::ptrdiff_t>(i)), after);
    add(*(last - static_cast<std::ptrdiff_t>(half + i)), before);
  }
  const MovedPair pair = pair_of(before, after, options_.event_pair_weight, events_.length);
  motion_.improve({&pair, 1}, field_, team_);
}

void EsiFlow::estimate_motion() {
  first_events_.clear();
  smooth_(model_.log_intensity(), intensity_before_, team_);
  cv::add(intensity_before_, events_.image, intensity_after_);
  const std::array pairs{MovedPair{intensity_before_, intensity_after_, 1.0F, 1.0F},
                         pair_of(events_before_, events_, options_.event_pair_weight, events_.length)};
  motion_.improve(pairs, field_, team_);
  motion_.correct_speed(pairs.back(), field_, team_);
}

void EsiFlow::turn_reversed_cells() {
  const cv::Mat1f signs = sign_.signs(field_);
  if (signs.empty()) return;
  field_.x = field_.x.mul(signs);
  field_.y = field_.y.mul(signs);
  sign_.turn(signs);
  model_.turn(signs, cells_);
}

const cv::Mat1f& EsiFlow::image_at(std::int64_t t_us) {
  const bool goes_on = last_window_ && windows_.open_begin_us() == last_window_->end_us;
  if (!goes_on || t_us <= last_window_->end_us) return model_.log_intensity();
  const auto passed_us = static_cast<double>(t_us - last_window_->end_us);
  const double share = std::min(length_of(windows_.open_events(), passed_us) / events_before_.length, 1.0);
  model_.move_image(field_, cells_, static_cast<float>(share), moved_on_, team_);
  return moved_on_;
}

const cv::Mat2f* EsiFlow::motion() {
  const std::int64_t window_us = last_window_ ? last_window_->duration_us() : options_.window_us;
  const auto per_s = static_cast<float>(1e6 / static_cast<double>(std::max<std::int64_t>(window_us, 1)));
  motion_px_s_.create(model_.log_intensity().size());
  std::vector<float> x(static_cast<std::size_t>(motion_px_s_.cols));
  std::vector<float> y(x.size());
  for (int row = 0; row < motion_px_s_.rows; ++row) {
    cells_.interpolate_row(field_.x, row, per_s, x.data());
    cells_.interpolate_row(field_.y, row, per_s, y.data());
    for (std::size_t i = 0; i < x.size(); ++i) motion_px_s_(row, static_cast<int>(i)) = {x[i], y[i]};
  }
  return &motion_px_s_;
}

void EsiFlow::render_levels(std::int64_t t_us, cv::Mat1f& levels) {
  const auto shift = team_.begin_shift();
  windows_.end_by(t_us, step());
  grey_levels(image_at(t_us), options_.contrast_deviations, levels, team_);
}

}  // namespace esi
