#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "esi/core/frame.hpp"
#include "esi/core/frame_schedule.hpp"
#include "esi/core/packet.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// One method on its way through a recording: events in, frames out when they are due. Several of them can
/// take the same packets.
class FrameLoop {
 public:
  /// `name` is what messages call the recording. What is referred to must outlive the loop.
  FrameLoop(FrameSchedule& schedule, Reconstructor& method, FrameSink& sink, std::int64_t max_frames,
            const std::string& name);

  /// The recording's next packet. Throws an Error when a frame's number would reach `max_frames`, before the
  /// frames of that gap are written.
  void take(const Packet& packet);

  /// At the recording's end: frames that are still due. `cut_at_us` is where the recording is known to go on
  /// after its last event; with or without events there, it lasts until then. Does not finish the sink.
  void finish(std::optional<std::int64_t> cut_at_us);

  std::int64_t frames() const { return frames_; }
  std::int64_t intensity_frames() const { return intensity_frames_; }

 private:
  void process(std::span<const Event> events, std::int64_t t_end_us);
  void feed(std::span<const Event> events);
  void render(std::int64_t t_us);
  void refuse_flood(std::int64_t t_us) const;

  FrameSchedule& schedule_;
  Reconstructor& method_;
  FrameSink& sink_;
  std::int64_t max_frames_;
  const std::string& name_;
  std::deque<IntensityFrame> unobserved_;
  std::int64_t events_since_frame_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t intensity_frames_ = 0;
  std::optional<std::int64_t> t_last_us_;
  Frame frame_;
};

}  // namespace esi
