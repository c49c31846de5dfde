#include "esi/pipeline/reconstruct.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {
namespace {

class Loop {
 public:
  Loop(EventSource& source, FrameSchedule& schedule, Reconstructor& method, FrameSink& sink,
       std::int64_t max_frames, const std::string& name)
      : source_(source),
        schedule_(schedule),
        method_(method),
        sink_(sink),
        max_frames_(max_frames),
        name_(name) {}

  Reconstruction run(const Observer& observer) {
    Packet packet;
    while (!result_.stopped && source_.next(packet)) {
      take(packet);
      result_.stopped = observer && !observer(progress());
    }
    if (!result_.stopped) finish();
    return std::move(result_);
  }

 private:
  void take(Packet& packet) {
    result_.digest.add(packet.events);
    schedule_.add_packet_ends(packet.packet_ends_us);
    for (const IntensityFrame& frame : packet.frames) schedule_.add_exposure_end(frame.exposure.end_us);
    std::move(packet.frames.begin(), packet.frames.end(), std::back_inserter(unobserved_));
    if (packet.events.empty()) return;
    const std::int64_t t_last_us = packet.events.back().t_us;
    refuse_flood(t_last_us);
    std::span<const Event> events = packet.events;
    while (const auto cut = schedule_.next(events)) {
      process(events.first(cut->events), cut->t_us);
      render(cut->t_us);
      events = events.subspan(cut->events);
    }
    process(events, t_last_us);  // a frame that is still to be cut is due after the last event
  }

  // Takes events, with the intensity frames whose exposures end by t_end_us in their places among them.
  void process(std::span<const Event> events, std::int64_t t_end_us) {
    for (; !unobserved_.empty() && unobserved_.front().exposure.end_us <= t_end_us; unobserved_.pop_front()) {
      const std::int64_t t_us = unobserved_.front().exposure.end_us;
      const auto first_later = std::partition_point(events.begin(), events.end(),
                                                    [t_us](const Event& event) { return event.t_us < t_us; });
      const auto earlier = static_cast<std::size_t>(first_later - events.begin());
      feed(events.first(earlier));
      method_.observe(unobserved_.front());
      ++result_.intensity_frames;
      events = events.subspan(earlier);
    }
    feed(events);
  }

  void feed(std::span<const Event> events) {
    method_.process(events);
    events_since_frame_ += static_cast<std::int64_t>(events.size());
  }

  void render(std::int64_t t_us) {
    method_.render(t_us, frame_.grey);
    frame_.index = result_.frames++;
    frame_.t_us = t_us;
    frame_.events_since_previous = std::exchange(events_since_frame_, 0);
    sink_.write(frame_);
  }

  void refuse_flood(std::int64_t t_us) const {
    const std::int64_t due = schedule_.frames_before(t_us);
    if (due < max_frames_) return;
    throw Error(
        fmt::format("{}: {} frames would be due by the event at {} s, more than --max-frames {}; the "
                    "recording has a gap or "
                    "starts late: use --start, a lower --fps, or --time-zero first-event",
                    name_, due, seconds_text(t_us), max_frames_));
  }

  // A recording that was cropped lasts until the cut, with or without events there.
  void finish() {
    auto t_last_us = result_.digest.t_last_us();
    if (const auto cut_us = source_.cut_at_us(); cut_us && t_last_us) t_last_us = *cut_us - 1;
    while (const auto cut = schedule_.last(t_last_us)) {
      process({}, cut->t_us);
      render(cut->t_us);
    }
  }

  Progress progress() const {
    return {result_.digest.events(), result_.frames, result_.digest.t_last_us().value_or(0),
            source_.fraction_read()};
  }

  EventSource& source_;
  FrameSchedule& schedule_;
  Reconstructor& method_;
  FrameSink& sink_;
  std::int64_t max_frames_;
  const std::string& name_;
  std::deque<IntensityFrame> unobserved_;
  std::int64_t events_since_frame_ = 0;
  Frame frame_;
  Reconstruction result_;
};

}  // namespace

Reconstruction reconstruct(EventSource& source, FrameSchedule& schedule, Reconstructor& method,
                           FrameSink& sink, std::int64_t max_frames, const std::string& name,
                           const Observer& observer) {
  return Loop(source, schedule, method, sink, max_frames, name).run(observer);
}

}  // namespace esi
