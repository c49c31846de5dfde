#include "esi/io/writing/packet_check.hpp"

#include <fmt/format.h>

#include <utility>

#include "esi/core/error.hpp"

namespace esi {
namespace {

// Times beyond this (36 thousand years) are garbage; within it, a time and an offset can be added.
constexpr std::int64_t kMaxTime_us = std::int64_t{1} << 60;

bool is_time(std::int64_t t_us) { return t_us > -kMaxTime_us && t_us < kMaxTime_us; }

bool is_side(int side_px) { return side_px > 0 && side_px <= kMaxSensorSide_px; }

}  // namespace

PacketCheck::PacketCheck(const WriteOptions& options, std::string name)
    : size_(options.size), name_(std::move(name)) {
  if (!is_side(size_.width_px) || !is_side(size_.height_px)) {
    throw usage_error(fmt::format("{}: a recording has a sensor of 1 to {} px a side, not {}", name_,
                                  kMaxSensorSide_px, to_string(size_)));
  }
  if (!is_time(options.t_offset_us)) {
    throw usage_error(fmt::format("{}: a time offset of {} us can't be", name_, options.t_offset_us));
  }
}

void PacketCheck::admit(const Packet& packet) {
  for (const Event& event : packet.events) admit_event(event);
  for (const IntensityFrame& frame : packet.frames) admit_frame(frame);
}

void PacketCheck::admit_event(const Event& event) {
  if (!is_time(event.t_us) || event.t_us < latest_us_) {
    throw Error(fmt::format("{}: an event at {} us cannot be written after one at {} us, sort them by time",
                            name_, event.t_us, latest_us_));
  }
  if (!size_.contains(event.x, event.y)) {
    throw Error(fmt::format("{}: the event at ({}, {}), {} us, lies outside the sensor of {} px", name_,
                            event.x, event.y, event.t_us, to_string(size_)));
  }
  latest_us_ = event.t_us;
}

void PacketCheck::admit_frame(const IntensityFrame& frame) {
  const Interval& exposure = frame.exposure;
  if (!is_time(exposure.begin_us) || !is_time(exposure.end_us) || exposure.end_us < exposure.begin_us ||
      exposure.end_us < latest_exposure_end_us_) {
    throw Error(
        fmt::format("{}: a frame exposed from {} to {} us cannot be written after one that ends at "
                    "{} us, sort them by the exposures' ends",
                    name_, exposure.begin_us, exposure.end_us, latest_exposure_end_us_));
  }
  const SensorSize size{frame.image.cols, frame.image.rows};
  const bool is_grey = frame.image.type() == CV_8UC1 || frame.image.type() == CV_16UC1;
  if (size != size_ || !is_grey) {
    throw Error(
        fmt::format("{}: the frame that ends at {} us has {} px and OpenCV's type {}, but 8 or 16 "
                    "bits of grey on {} px are needed",
                    name_, exposure.end_us, to_string(size), frame.image.type(), to_string(size_)));
  }
  latest_exposure_end_us_ = exposure.end_us;
}

}  // namespace esi
