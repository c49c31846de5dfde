#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "esi/recon/flow/esi_flow.hpp"
#include "recon/flow/textures.hpp"

namespace esi::test {

inline constexpr SensorSize kSize{96, 80};
inline const Waves kWaves(11, 8.0, 60.0);

/// The camera moves along a circle until `stop_us`, then stands still.
inline cv::Point2d place_at(double t_s, double stop_s) {
  const double turn = 4.0 * std::min(t_s, stop_s);
  return {20.0 * std::sin(turn), 20.0 * std::cos(turn)};
}

inline double scene(int x, int y, double t_s, double stop_s = 1e9) {
  return 0.5 * kWaves.at(cv::Point2d(x, y) - place_at(t_s, stop_s));
}

inline const std::vector<Event>& moving_events() {
  static const std::vector<Event> events =
      events_of(kSize, 0, 600'000, 0.15, [](int x, int y, double t_s) { return scene(x, y, t_s); });
  return events;
}

inline cv::Mat1f truth(double t_s, double stop_s = 1e9) {
  return image_of({kSize.width_px, kSize.height_px}, [&](int x, int y) { return scene(x, y, t_s, stop_s); });
}

/// Those with t < t_us, from `given` on, which is moved on.
inline std::span<const Event> events_until(const std::vector<Event>& events, std::size_t& given,
                                           std::int64_t t_us) {
  const auto begin = events.begin() + static_cast<std::ptrdiff_t>(given);
  const auto end =
      std::partition_point(begin, events.end(), [t_us](const Event& e) { return e.t_us < t_us; });
  const std::span<const Event> due(begin, end);
  given += due.size();
  return due;
}

inline cv::Mat1f levels_at(EsiFlow& flow, std::int64_t t_us) {
  cv::Mat1f levels;
  flow.render_levels(t_us, levels);
  return levels;
}

/// Frames at the times, in order; the events of each come in calls of at most `largest`.
inline std::vector<cv::Mat1f> frames_of(const EsiFlowOptions& options, const std::vector<Event>& events,
                                        const std::vector<std::int64_t>& times_us,
                                        std::size_t largest = 1'000'000) {
  EsiFlow flow(options, kSize);
  std::size_t given = 0;
  std::vector<cv::Mat1f> frames;
  for (const std::int64_t t_us : times_us) {
    for (auto due = events_until(events, given, t_us); !due.empty();
         due = due.subspan(std::min(largest, due.size()))) {
      flow.process(due.first(std::min(largest, due.size())));
    }
    frames.push_back(levels_at(flow, t_us));
  }
  return frames;
}

inline EsiFlowOptions by_events(double events_per_pixel) {
  EsiFlowOptions options;
  options.window = EsiFlowOptions::Window::events;
  options.events_per_pixel = events_per_pixel;
  return options;
}

/// Windows of time, and of events: those last for about 7 ms here.
inline const std::vector<EsiFlowOptions> kBothWindows{{}, by_events(0.35)};

inline std::vector<std::int64_t> every(std::int64_t period_us, std::int64_t end_us) {
  std::vector<std::int64_t> times_us;
  for (std::int64_t t_us = period_us; t_us <= end_us; t_us += period_us) times_us.push_back(t_us);
  return times_us;
}

}  // namespace esi::test
