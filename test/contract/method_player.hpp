#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "contract/methods_under_test.hpp"
#include "support/random_events.hpp"

namespace esi::test {

inline constexpr SensorSize kSize{40, 32};
/// Events keep away this far from the border, so that a shift keeps them inside.
inline constexpr int kMargin = 8;

inline std::vector<Event> scene(unsigned seed) {
  const Region inner{kMargin, kMargin, kSize.width_px - 2 * kMargin, kSize.height_px - 2 * kMargin};
  return random_events(inner, 20000, 20, seed);
}

inline std::vector<Event> shifted(std::vector<Event> events, std::int64_t t_us, int x, int y) {
  for (Event& event : events) {
    event.t_us += t_us;
    event.x = static_cast<std::uint16_t>(event.x + x);
    event.y = static_cast<std::uint16_t>(event.y + y);
  }
  return events;
}

/// An intensity frame every 40 ms, exposed for 25 ms; each flat, so that a shift in space changes nothing.
inline IntensityFrame intensity_frame(int k, std::int64_t t0_us) {
  const std::int64_t end_us = t0_us + 30000 + std::int64_t{k} * 40000;
  return {{end_us - 25000, end_us},
          cv::Mat1b(kSize.height_px, kSize.width_px, static_cast<std::uint8_t>(90 + 10 * (k % 6)))};
}

/// Plays events in calls of `call_size()` each, with the intensity frames in their places among them, as long
/// as there are events.
class Player {
 public:
  Player(Reconstructor& reconstructor, std::span<const Event> events, std::int64_t t0_us,
         std::span<const float> weights = {})
      : reconstructor_(reconstructor),
        events_(events),
        weights_(weights),
        t0_us_(t0_us),
        t_last_us_(events.back().t_us) {}

  bool is_at_end() const { return events_.empty(); }

  /// Everything before t_us.
  template <class CallSize>
  void play_until(std::int64_t t_us, CallSize call_size) {
    for (; intensity_frame(seen_, t0_us_).exposure.end_us <= std::min(t_us, t_last_us_); ++seen_) {
      const IntensityFrame frame = intensity_frame(seen_, t0_us_);
      feed(frame.exposure.end_us, call_size);
      reconstructor_.observe(frame);
    }
    feed(t_us, call_size);
  }
  void play_until(std::int64_t t_us) {
    play_until(t_us, [] { return std::size_t{1000000}; });
  }

 private:
  template <class CallSize>
  void feed(std::int64_t t_us, CallSize call_size) {
    std::size_t due = 0;
    while (due < events_.size() && events_[due].t_us < t_us) ++due;
    while (due > 0) {
      const std::size_t count = std::min<std::size_t>(due, call_size());
      reconstructor_.process(events_.first(count), weights_.first(std::min(count, weights_.size())));
      events_ = events_.subspan(count);
      weights_ = weights_.subspan(std::min(count, weights_.size()));
      due -= count;
    }
  }

  Reconstructor& reconstructor_;
  std::span<const Event> events_;
  std::span<const float> weights_;
  std::int64_t t0_us_;
  std::int64_t t_last_us_;  ///< last event
  int seen_ = 0;            ///< intensity frames
};

/// Frames every 50 ms from t0_us on, the events given in calls of `call_size()` each.
template <class CallSize>
inline std::vector<cv::Mat1b> frames_of(Reconstructor& reconstructor, std::span<const Event> events,
                                        std::int64_t t0_us, CallSize call_size) {
  std::vector<cv::Mat1b> frames;
  Player player(reconstructor, events, t0_us);
  while (!player.is_at_end()) {
    const std::int64_t t_us = t0_us + static_cast<std::int64_t>(frames.size() + 1) * 50000;
    player.play_until(t_us, call_size);
    reconstructor.render(t_us, frames.emplace_back());
  }
  return frames;
}

inline std::vector<cv::Mat1b> frames_of(const MethodConfig& config, std::span<const Event> events,
                                        std::int64_t t0_us = 0) {
  const auto reconstructor = created(config, kSize);
  return frames_of(*reconstructor, events, t0_us, [] { return std::size_t{1000000}; });
}

/// The time of the last of those frames.
inline std::int64_t last_frame_us(std::span<const Event> events) {
  return (events.back().t_us / 50000 + 1) * 50000;
}

/// A reconstructor that has seen all events and intensity frames up to that time.
inline std::unique_ptr<Reconstructor> played(const MethodConfig& config, std::span<const Event> events,
                                             std::span<const float> weights = {}) {
  auto reconstructor = created(config, kSize);
  Player(*reconstructor, events, 0, weights).play_until(last_frame_us(events));
  return reconstructor;
}

inline bool are_equal(const cv::Mat1b& a, const cv::Mat1b& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

inline bool is_flat(const cv::Mat1b& grey) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(grey, &low, &high);
  return low == high;
}

}  // namespace esi::test
