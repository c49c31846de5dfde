#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/core/row_team.hpp"
#include "esi/recon/event_windows.hpp"
#include "esi/recon/flow/brightness_model.hpp"
#include "esi/recon/flow/event_image.hpp"
#include "esi/recon/flow/half_size.hpp"
#include "esi/recon/flow/motion_estimator.hpp"
#include "esi/recon/flow/motion_sign.hpp"
#include "esi/recon/flow/multilevel_solver.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Reconstruction that uses motion; docs/esi_flow.md has the equations that are numbered here.
struct EsiFlowOptions {
  enum class Window { events, time };

  Window window = Window::time;
  double events_per_pixel = 0.3;
  std::int64_t window_us = 10'000;
  bool balance = true;
  double flow_blur_px = 1.2;
  std::int64_t cell_px = 16;
  double flow_regularisation = 0.02;
  double event_pair_weight = 5.0;
  double flow_hold = 0.5;
  std::int64_t flow_rounds = 1;
  double memory = 1.0;
  double memory_px = 1.0;
  double eps = 0.003;
  double mu = 0.0001;
  std::int64_t levels = 4;
  std::int64_t steps_full = 4;
  std::int64_t steps_half = 6;
  std::int64_t steps_coarse = 12;
  std::int64_t cycles = 1;
  std::int64_t first_cycles = 8;
  std::int64_t first_windows = 20;
  double contrast_deviations = 1.5;

  void declare(OptionTable& table);

  BrightnessModel::Options model() const;
  MultilevelSolver::Options solver() const;
};

/// Smooth event images, at half resolution, of one window or the sum of some in a row. How far the image
/// moves meanwhile, and how strong its events are, is taken to grow with `length`: with time in windows of
/// time, and with events in windows of events, since an image that moves twice as fast makes twice as many.
struct SmoothEvents {
  cv::Mat1f image;
  double length = 0.0;
};

class EsiFlow final : public Reconstructor {
 public:
  EsiFlow(const EsiFlowOptions& options, SensorSize size);

  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override;
  const cv::Mat2f* motion() override;
  void use_workers(std::shared_ptr<WorkerPool> workers) override { team_.use(std::move(workers)); }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override;
  EventWindows::Take step();
  void take_window(std::span<const Event> window, std::span<const float> weights);
  /// Turns the last window's motion into what it lets expect of the next one.
  void expect_motion(const Interval& next);
  double length_of(std::size_t events, double duration_us) const;
  /// The window's motion, from what is expected of it on.
  void find_motion();
  void estimate_motion();
  void estimate_first_motion();
  /// Where the motion's sign is wrong, so is the image's.
  void turn_reversed_cells();
  /// The image at t_us: that of the last window, moved on where events show that the motion goes on.
  const cv::Mat1f& image_at(std::int64_t t_us);

  EsiFlowOptions options_;
  RowTeam team_;
  EventWindows windows_;
  EventImage event_image_;
  SmoothHalf smooth_;
  MotionEstimator motion_;
  MotionSign sign_;
  CellGrid cells_;  ///< over the full resolution
  BrightnessModel model_;
  MultilevelSolver solver_;
  MotionField field_;
  std::int64_t windows_seen_ = 0;
  std::vector<SmoothEvents> first_events_;  ///< of the windows so far, until the flow has started
  SmoothEvents events_, events_before_;
  cv::Mat1f intensity_before_, intensity_after_;  ///< smooth, half resolution
  cv::Mat1f rhs_;
  cv::Mat1f moved_on_;
  cv::Mat2f motion_px_s_;
  std::optional<Interval> last_window_;
};

}  // namespace esi
