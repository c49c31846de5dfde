#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace esi {

/// Times of a text recording in file order: unwraps a counter of 31 or 32 bits, and knows how long it lasts.
class TextClock {
 public:
  /// A step that is longer (18 min) or goes back needs accept(); any other may be taken by follow().
  static constexpr std::int64_t kMaxPlainStep_us = std::int64_t{1} << 30;

  /// Only whole microseconds come from a counter that wraps.
  explicit TextClock(bool may_wrap) : may_wrap_(may_wrap) {}

  /// The time of the next event with its wraps added.
  std::int64_t accept(std::int64_t raw_us);

  /// Takes note of events that rose from previous_us() to raw_us by plain steps. Their time is raw_us +
  /// offset_us().
  void follow(std::int64_t raw_us);

  bool has_started() const { return min_us_ <= max_us_; }
  std::int64_t previous_us() const { return previous_us_; }  ///< as written
  std::int64_t offset_us() const { return offset_us_; }      ///< of the wraps so far
  std::int64_t latest_us() const { return latest_us_; }      ///< previous_us() with its wraps
  std::int64_t duration_us() const { return has_started() ? max_us_ - min_us_ : 0; }

  /// Bits of the counter that wrapped, or 0.
  int wrapped_bits() const { return period_us_ == 0 ? 0 : period_us_ == std::int64_t{1} << 31 ? 31 : 32; }

 private:
  void unwrap(std::int64_t raw_us);

  bool may_wrap_;
  std::int64_t period_us_ = 0;  ///< of the counter, once it has wrapped
  std::int64_t offset_us_ = 0;
  std::int64_t previous_us_ = 0;
  std::int64_t latest_us_ = 0;
  std::int64_t min_us_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t max_us_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace esi
