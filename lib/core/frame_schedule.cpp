#include "esi/core/frame_schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "esi/core/error.hpp"

namespace esi {
namespace {

__extension__ using Int128 = __int128;  // k * 1e12 leaves 64 bits after 9 million frames

std::size_t count_before(std::span<const Event> events, std::int64_t t_us) {
  const auto first_not_before = std::partition_point(
      events.begin(), events.end(), [t_us](const Event& event) { return event.t_us < t_us; });
  return static_cast<std::size_t>(first_not_before - events.begin());
}

bool reaches(std::span<const Event> events, std::int64_t t_us) {
  return !events.empty() && events.back().t_us >= t_us;
}

}  // namespace

FixedRate::FixedRate(double fps, std::int64_t begin_us)
    : rate_uhz_(std::llround(fps * 1e6)), begin_us_(begin_us) {
  if (rate_uhz_ < 1 || rate_uhz_ > 1'000'000'000'000) {
    throw usage_error(fmt::format("a rate of {} frames per second is not possible, give 1e-6 to 1e6", fps));
  }
}

std::int64_t FixedRate::due_us(std::int64_t k) const {
  const Int128 elapsed = (Int128{k} + 1) * 1'000'000'000'000;
  return begin_us_ + static_cast<std::int64_t>((elapsed + rate_uhz_ - 1) / rate_uhz_);
}

std::optional<FrameCut> FixedRate::next(std::span<const Event> events) {
  const std::int64_t t_us = due_us(index_);
  if (!reaches(events, t_us)) return std::nullopt;
  ++index_;
  return FrameCut{count_before(events, t_us), t_us};
}

// The frame with the last event is due after it; all earlier ones have been cut.
std::optional<FrameCut> FixedRate::last(std::optional<std::int64_t> t_last_us) {
  const bool due = t_last_us && *t_last_us >= begin_us_ && (index_ == 0 || due_us(index_ - 1) <= *t_last_us);
  if (!due) return std::nullopt;
  return FrameCut{0, due_us(index_++)};
}

std::int64_t FixedRate::frames_before(std::int64_t t_us) const {
  if (t_us < begin_us_) return 0;
  const Int128 frames = (Int128{t_us} - begin_us_) * rate_uhz_ / 1'000'000'000'000;
  return static_cast<std::int64_t>(std::min<Int128>(frames, INT64_MAX));
}

std::optional<FrameCut> EveryNEvents::next(std::span<const Event> events) {
  if (events.empty()) return std::nullopt;
  const auto in_span = static_cast<std::int64_t>(events.size());
  if (seen_ + in_span < n_) {
    seen_ += in_span;
    t_seen_last_us_ = events.back().t_us;
    return std::nullopt;
  }
  // The n-th event is here or was the last one seen; its microsecond must be over before the cut.
  const std::int64_t t_nth_us =
      seen_ >= n_ ? t_seen_last_us_ : events[static_cast<std::size_t>(n_ - seen_ - 1)].t_us;
  const std::size_t shown = count_before(events, t_nth_us + 1);
  if (shown == events.size()) {
    seen_ += in_span;
    t_seen_last_us_ = t_nth_us;
    return std::nullopt;
  }
  seen_ = 0;
  return FrameCut{shown, t_nth_us + 1};
}

std::optional<FrameCut> EveryNEvents::last(std::optional<std::int64_t> t_last_us) {
  if (seen_ == 0 || !t_last_us) return std::nullopt;
  seen_ = 0;
  return FrameCut{0, *t_last_us + 1};
}

std::optional<FrameCut> AtTimes::next(std::span<const Event> events) {
  if (index_ == times_us_.size() || !reaches(events, times_us_[index_])) return std::nullopt;
  const std::int64_t t_us = times_us_[index_++];
  return FrameCut{count_before(events, t_us), t_us};
}

std::optional<FrameCut> AtTimes::last(std::optional<std::int64_t> /*t_last_us*/) {
  if (index_ == times_us_.size()) return std::nullopt;
  return FrameCut{0, times_us_[index_++]};
}

void AtEnds::add(std::int64_t end_us) {
  earliest_us_ = std::max(end_us, earliest_us_);
  ends_us_.push_back(earliest_us_);
}

std::optional<FrameCut> AtEnds::next(std::span<const Event> events) {
  if (index_ == ends_us_.size() || !reaches(events, ends_us_[index_])) {
    if (!events.empty()) earliest_us_ = std::max(earliest_us_, events.back().t_us + 1);
    return std::nullopt;
  }
  const std::int64_t t_us = ends_us_[index_++];
  if (index_ == ends_us_.size()) {  // keeps the list short
    ends_us_.clear();
    index_ = 0;
  }
  return FrameCut{count_before(events, t_us), t_us};
}

std::optional<FrameCut> AtEnds::last(std::optional<std::int64_t> /*t_last_us*/) {
  if (index_ == ends_us_.size()) return std::nullopt;
  return FrameCut{0, ends_us_[index_++]};
}

}  // namespace esi
