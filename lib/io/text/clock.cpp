#include "esi/io/text/clock.hpp"

#include <algorithm>

namespace esi {
namespace {

// The period of a counter that steps from `from` to `to`, or 0 where that is no wrap. It must come from the
// top eighth of the counter's range and fall by more than half of it.
std::int64_t wrap_period(std::int64_t from, std::int64_t to) {
  constexpr std::int64_t k31 = std::int64_t{1} << 31, k32 = std::int64_t{1} << 32;
  const auto is_near = [from](std::int64_t top) { return from < top && from >= top - top / 8; };
  if (is_near(k32) && to >= 0 && from - to > k32 / 2) return k32;
  if (is_near(k31) && to >= 0 && from - to > k31 / 2) return k31;
  if (is_near(k31) && to < 0 && to >= -k31 && from - to > k32 / 2) return k32;  // a signed counter
  return 0;
}

constexpr std::int64_t kMaxJitter_us = 10'000'000;  // further back, a step up is a gap

}  // namespace

// An event that jitters back over a wrap steps up by nearly a period: it belongs to the round before.
void TextClock::unwrap(std::int64_t raw_us) {
  if (raw_us < previous_us_) {
    const std::int64_t period = wrap_period(previous_us_, raw_us);
    if (period != 0 && (period_us_ == 0 || period == period_us_)) {
      period_us_ = period;
      offset_us_ += period;
    }
  } else if (offset_us_ > 0 && previous_us_ + period_us_ - raw_us <= kMaxJitter_us) {
    offset_us_ -= period_us_;
  }
}

std::int64_t TextClock::accept(std::int64_t raw_us) {
  if (may_wrap_ && has_started()) unwrap(raw_us);
  follow(raw_us);
  return latest_us_;
}

void TextClock::follow(std::int64_t raw_us) {
  if (!has_started()) min_us_ = max_us_ = raw_us;
  previous_us_ = raw_us;
  latest_us_ = raw_us + offset_us_;
  min_us_ = std::min(min_us_, latest_us_);
  max_us_ = std::max(max_us_, latest_us_);
}

}  // namespace esi
