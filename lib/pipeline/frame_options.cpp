#include "esi/pipeline/frame_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "esi/core/error.hpp"
#include "esi/io/times_file.hpp"

namespace esi {
namespace {

constexpr double kMaxSeconds = 1e10;  // three centuries

void check_region(const std::string& text) {
  if (!text.empty()) parse_region(text);
}

}  // namespace

void FrameOptions::declare(OptionTable& table) {
  table.real("fps", fps, {1e-6, 1e6}, "1/s", "frames per second of the recording");
  table.integer("every_events", every_events, {0, std::int64_t{1} << 40}, "",
                "a frame after every so many events instead (0: off); ties in time stay together");
  table.text("times", times, "frames at the times (s) of this file instead, one a line");
  table.toggle("packets", packets, "a frame at the end of each of the file's own packets instead");
  table.toggle("at_frames", at_frames,
               "a frame at the end of each of the recording's intensity frames instead");
  table.optional_real("start", start_s, {-kMaxSeconds, kMaxSeconds}, "s", "leave out what comes before");
  table.optional_real("end", end_s, {-kMaxSeconds, kMaxSeconds}, "s", "leave out what comes at or after it");
  table.optional_real("duration", duration_s, {0.0, kMaxSeconds}, "s", "the same, counted from the start");
  table.text("roi", roi, "region of interest X,Y,WIDTHxHEIGHT in px; its corner becomes the origin",
             check_region);
  table.integer("max_frames", max_frames, {1, std::int64_t{1} << 40}, "",
                "more frames than this are refused before they are written");
}

void FrameOptions::check() const {
  const int rules =
      (every_events > 0 ? 1 : 0) + (times.empty() ? 0 : 1) + (packets ? 1 : 0) + (at_frames ? 1 : 0);
  if (rules > 1) {
    throw usage_error("--every-events, --times, --packets and --at-frames exclude each other; give one");
  }
  if (end_s && duration_s) throw usage_error("--end and --duration exclude each other; give one");
  if (interval().is_empty())
    throw usage_error("nothing lies between --start and --end: the end must be later");
}

Interval FrameOptions::interval() const {
  Interval interval;
  if (start_s) interval.begin_us = us_from_seconds(*start_s);
  if (end_s) interval.end_us = us_from_seconds(*end_s);
  if (duration_s) interval.end_us = us_from_seconds(start_s.value_or(0.0)) + us_from_seconds(*duration_s);
  return interval;
}

std::optional<Region> FrameOptions::region() const {
  return roi.empty() ? std::nullopt : std::optional(parse_region(roi));
}

double FrameOptions::video_fps() const {
  const bool fixed_rate = every_events == 0 && times.empty() && !packets && !at_frames;
  return fixed_rate ? fps : 100.0;
}

std::unique_ptr<FrameSchedule> FrameOptions::make_schedule() const {
  if (every_events > 0) return std::make_unique<EveryNEvents>(every_events);
  if (!times.empty()) return std::make_unique<AtTimes>(read_times(times));
  if (packets) return std::make_unique<AtPacketEnds>();
  if (at_frames) return std::make_unique<AtIntensityFrames>();
  return std::make_unique<FixedRate>(fps, start_s ? us_from_seconds(*start_s) : 0);
}

FrameOptions with_schedule_of(FrameOptions part, const FrameOptions& schedule) {
  part.fps = schedule.fps;
  part.every_events = schedule.every_events;
  part.times = schedule.times;
  part.packets = schedule.packets;
  part.at_frames = schedule.at_frames;
  return part;
}

}  // namespace esi
