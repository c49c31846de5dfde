#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// Where a frame is cut out of a run of events: it shows the first `events` of them, all with t < t_us.
struct FrameCut {
  std::size_t events = 0;
  std::int64_t t_us = 0;
};

/// Says when frames are due, as the events come in. Whatever the rule: a frame at T shows exactly the events
/// with t < T.
class FrameSchedule {
 public:
  virtual ~FrameSchedule() = default;

  /// The first cut within `events` (sorted, following those of the last call), or nothing when all of them
  /// belong to frames not yet due. After a cut, call again with the events behind it.
  virtual std::optional<FrameCut> next(std::span<const Event> events) = 0;

  /// At the end of the recording, whose last event was at t_last_us: the next frame that is still due.
  /// Call until there is none.
  virtual std::optional<FrameCut> last(std::optional<std::int64_t> t_last_us) = 0;

  /// Frames that `next` would cut before an event at t_us, if that can be told. For refusing absurd numbers.
  virtual std::int64_t frames_before(std::int64_t /*t_us*/) const { return 0; }

  /// The file's own packets end at these times (half-open). Only the per-packet schedule listens.
  virtual void add_packet_ends(std::span<const std::int64_t> /*ends_us*/) {}

  /// The exposure of an intensity frame ends at this time. Only the schedule at intensity frames listens.
  virtual void add_exposure_end(std::int64_t /*end_us*/) {}
};

/// Frame k is due at begin + (k+1) * period, computed from k, so that it can't drift.
class FixedRate final : public FrameSchedule {
 public:
  /// fps is taken to the micro-hertz, up to 1e6.
  FixedRate(double fps, std::int64_t begin_us);

  std::optional<FrameCut> next(std::span<const Event> events) override;
  std::optional<FrameCut> last(std::optional<std::int64_t> t_last_us) override;
  std::int64_t frames_before(std::int64_t t_us) const override;

  /// Smallest whole microsecond that is not before the end of frame k.
  std::int64_t due_us(std::int64_t k) const;

 private:
  std::int64_t rate_uhz_;
  std::int64_t begin_us_;
  std::int64_t index_ = 0;
};

/// A frame after every n events. Events at the same microsecond stay together, so a frame may show a few
/// more. The last frame shows the rest.
class EveryNEvents final : public FrameSchedule {
 public:
  explicit EveryNEvents(std::int64_t n) : n_(n) {}

  std::optional<FrameCut> next(std::span<const Event> events) override;
  std::optional<FrameCut> last(std::optional<std::int64_t> t_last_us) override;

 private:
  std::int64_t n_;
  std::int64_t seen_ = 0;            ///< events of earlier calls that wait for the next cut
  std::int64_t t_seen_last_us_ = 0;  ///< time of the last of them
};

/// Frames at given times, in ascending order. Those behind the recording's end are due at the end.
class AtTimes final : public FrameSchedule {
 public:
  explicit AtTimes(std::vector<std::int64_t> times_us) : times_us_(std::move(times_us)) {}

  std::optional<FrameCut> next(std::span<const Event> events) override;
  std::optional<FrameCut> last(std::optional<std::int64_t> t_last_us) override;

 private:
  std::vector<std::int64_t> times_us_;
  std::size_t index_ = 0;
};

/// Frames at times that become known as the recording is read.
class AtEnds : public FrameSchedule {
 public:
  std::optional<FrameCut> next(std::span<const Event> events) override;
  std::optional<FrameCut> last(std::optional<std::int64_t> t_last_us) override;

 protected:
  /// Ends that come too late, before an earlier one or an event already seen, are put behind those.
  void add(std::int64_t end_us);

 private:
  std::vector<std::int64_t> ends_us_;
  std::size_t index_ = 0;
  std::int64_t earliest_us_ = std::numeric_limits<std::int64_t>::min();  ///< of the next end
};

/// A frame at the end of each of the file's own packets.
class AtPacketEnds final : public AtEnds {
 public:
  void add_packet_ends(std::span<const std::int64_t> ends_us) override {
    for (const std::int64_t end_us : ends_us) add(end_us);
  }
};

/// A frame at the end of each intensity frame's exposure.
class AtIntensityFrames final : public AtEnds {
 public:
  void add_exposure_end(std::int64_t end_us) override { add(end_us); }
};

}  // namespace esi
