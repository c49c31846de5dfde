#include "esi/pipeline/reconstruct.hpp"

#include "esi/pipeline/frame_loop.hpp"

namespace esi {

Reconstruction reconstruct(EventSource& source, FrameSchedule& schedule, Reconstructor& method,
                           FrameSink& sink, std::int64_t max_frames, const std::string& name,
                           const Observer& observer) {
  FrameLoop loop(schedule, method, sink, max_frames, name);
  Reconstruction result;
  const auto is_told_to_stop = [&] {
    return observer && !observer({result.digest.events(), loop.frames(),
                                  result.digest.t_last_us().value_or(0), source.fraction_read()});
  };
  Packet packet;
  while (!result.stopped && source.next(packet)) {
    result.digest.add(packet.events);
    loop.take(packet);
    result.stopped = is_told_to_stop();
  }
  if (!result.stopped) loop.finish(source.cut_at_us());
  result.frames = loop.frames();
  result.intensity_frames = loop.intensity_frames();
  return result;
}

}  // namespace esi
