#pragma once

#include <cstdint>
#include <string>

#include "esi/core/frame_schedule.hpp"
#include "esi/io/event_digest.hpp"
#include "esi/io/event_source.hpp"
#include "esi/io/output/frame_sink.hpp"
#include "esi/pipeline/progress.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

struct Reconstruction {
  EventDigest digest;  ///< of the events used
  std::int64_t frames = 0;
  std::int64_t intensity_frames = 0;
  bool stopped = false;  ///< by the observer
};

/// The one loop: pulls events from the left, pushes frames to the right. The frame at T shows exactly the
/// events with t < T; intensity frames reach the method in order, at the ends of their exposures.
/// Does not finish the sink.
/// Throws an Error when a frame's number would reach `max_frames`, before the frames of that gap are written.
/// `name` is what messages call the recording.
Reconstruction reconstruct(EventSource& source, FrameSchedule& schedule, Reconstructor& method,
                           FrameSink& sink, std::int64_t max_frames, const std::string& name,
                           const Observer& observer);

}  // namespace esi
