#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/time.hpp"

namespace esi {

/// Gathers events into windows, which don't depend on how the events are cut into calls. Three kinds:
/// - of_count: so many events each, with no times of their own.
/// - of_duration: [k D, (k + 1) D) on the recording's clock, left out where empty.
/// - of_count_within: so many events or the longest duration, whichever comes first. A window begins where
///   the one before ended; where that has no event for the longest duration, at the next event. It ends after
///   the whole microsecond of its last event, and lasts kShortestWindow_us at least.
class EventWindows {
 public:
  static constexpr std::int64_t kShortestWindow_us = 500;

  /// A window's events, at least one, with as many weights.
  using Take = std::function<void(std::span<const Event>, std::span<const float>)>;

  static EventWindows of_count(std::size_t events) { return {Kind::count, events, 0}; }
  static EventWindows of_duration(std::int64_t duration_us) { return {Kind::time, 0, duration_us}; }
  static EventWindows of_count_within(std::size_t events, std::int64_t longest_us) {
    return {Kind::both, events, longest_us};
  }

  /// Adds events in order of time, and hands on the windows that they end. `weights` are empty (all 1) or one
  /// a piece.
  void add(std::span<const Event> events, std::span<const float> weights, const Take& take);

  /// Hands on the window with times that has ended by t_us, if there is one: no event before t_us is still to
  /// come.
  void end_by(std::int64_t t_us, const Take& take);

  /// The window that is being handed on, or was last; none in windows of a count.
  const std::optional<Interval>& last() const { return last_; }

  /// Where the window begins that has events and has not ended; none in windows of a count.
  std::optional<std::int64_t> open_begin_us() const;

  /// How many events have come that are in no window yet that was handed on.
  std::size_t open_events() const { return events_.size(); }

 private:
  enum class Kind { count, time, both };

  EventWindows(Kind kind, std::size_t count, std::int64_t duration_us)
      : kind_(kind), count_(count), duration_us_(duration_us) {}

  std::int64_t begin_of_window_with(std::int64_t t_us) const;
  /// How many events, from the first on, go into the open window.
  std::size_t fitting(std::span<const Event> events) const;
  void end_at_count(const Take& take);
  void hand_on(const Take& take);

  Kind kind_;
  std::size_t count_;         ///< of a window's events, or 0
  std::int64_t duration_us_;  ///< of a window, or at most, or 0
  std::vector<Event> events_;
  std::vector<float> weights_;
  Interval open_;  ///< of events_, if there are any
  std::optional<Interval> last_;
};

}  // namespace esi
