#pragma once

#include <vector>

#include "esi/core/cpu_time.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Measures what another reconstructor costs, frame by frame: all that happens up to a frame counts for it.
class TimedReconstructor final : public Reconstructor {
 public:
  explicit TimedReconstructor(Reconstructor& timed) : timed_(timed) {}

  void observe(const IntensityFrame& frame) override {
    measure([&] { timed_.observe(frame); });
  }
  void render(std::int64_t t_us, cv::Mat1b& grey) override {
    measure([&] { timed_.render(t_us, grey); });
    end_frame();
  }
  void render_levels(std::int64_t t_us, cv::Mat1f& levels) override {
    measure([&] { timed_.render_levels(t_us, levels); });
    end_frame();
  }

  std::int64_t events() const { return events_; }
  std::vector<double>& frame_ms() { return frame_ms_; }

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override {
    events_ += static_cast<std::int64_t>(events.size());
    measure([&] { timed_.process(events, weights); });
  }

  template <class Work>
  void measure(Work work) {
    const double begin_s = thread_cpu_s();
    work();
    spent_s_ += thread_cpu_s() - begin_s;
  }

  void end_frame() {
    frame_ms_.push_back(1e3 * spent_s_);
    spent_s_ = 0.0;
  }

  Reconstructor& timed_;
  std::int64_t events_ = 0;
  double spent_s_ = 0.0;
  std::vector<double> frame_ms_;
};

}  // namespace esi
