#pragma once

#include <algorithm>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/steps/recent_times.hpp"

// Steps before a method: each says of every event of the stream, in order, whether it is kept.

namespace esi {

struct EventFilterOptions {
  std::int64_t background_us = 0;  ///< 0: off
  std::int64_t refractory_us = 0;  ///< 0: off
  std::string hot_pixels;          ///< "x,y x,y", "learn", or empty

  void declare(OptionTable& table);
  static void declare_background(OptionTable& table, std::int64_t& background_us);

  /// Whether whoever knows the recording is to find the hot pixels in it.
  bool learns_hot_pixels() const { return hot_pixels == "learn"; }
};

/// Reads "12,40 13,41". Throws a usage Error that shows the form.
std::vector<cv::Point> parse_pixels(std::string_view text);

/// Removes the events of pixels that fire whatever they see.
class HotPixelFilter {
 public:
  /// Throws a usage Error where a pixel lies outside the sensor.
  HotPixelFilter(std::span<const cv::Point> hot, SensorSize size);

  bool keep(const Event& event) const { return !is_hot_[event.y * width_px_ + event.x]; }

 private:
  std::size_t width_px_;
  std::vector<bool> is_hot_;
};

/// Removes events that follow their pixel's last kept one by less than a period.
class RefractoryFilter {
 public:
  RefractoryFilter(std::int64_t period_us, SensorSize size)
      : period_us_(static_cast<std::int32_t>(period_us)), times_(size) {}

  bool keep(const Event& event) {
    const std::int32_t now_us = times_.now(event);
    std::int32_t& last_kept_us = times_.cell_us(event);
    if (now_us - last_kept_us < period_us_) return false;
    last_kept_us = now_us;
    return true;
  }

 private:
  std::int32_t period_us_;
  RecentTimes times_;
};

/// Background activity: keeps an event only when one of its 8 neighbours fired at most `within_us` before,
/// itself kept or not (Delbruck 2008).
class BackgroundFilter {
 public:
  BackgroundFilter(std::int64_t within_us, SensorSize size)
      : within_us_(static_cast<std::int32_t>(within_us)), times_(size) {}

  bool keep(const Event& event) {
    const std::int32_t now_us = times_.now(event);
    std::int32_t& own = times_.cell_us(event);
    own = now_us;
    const std::int32_t* const above = &own - times_.stride();
    const std::int32_t* const below = &own + times_.stride();
    const auto latest = [](const std::int32_t* row) { return std::max({row[-1], row[0], row[1]}); };
    const std::int32_t beside = std::max((&own)[-1], (&own)[1]);
    return now_us - std::max({latest(above), latest(below), beside}) <= within_us_;
  }

 private:
  std::int32_t within_us_;
  RecentTimes times_;
};

/// Takes out of `events`, and out of `weights` where there are any, what the filter doesn't keep.
/// Returns how many it took out.
template <class Filter>
std::int64_t remove_unkept(Filter& filter, std::vector<Event>& events, std::vector<float>& weights) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event event = events[i];
    events[kept] = event;
    if (!weights.empty()) weights[kept] = weights[i];
    kept += filter.keep(event) ? 1 : 0;  // no branch: what is kept looks random
  }
  const auto removed = static_cast<std::int64_t>(events.size() - kept);
  events.resize(kept);
  if (!weights.empty()) weights.resize(kept);
  return removed;
}

}  // namespace esi
