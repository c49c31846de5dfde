#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// Gathers events into windows: of a fixed number of events, or of a fixed duration, [k D, (k + 1) D) on the
/// recording's clock. Windows don't depend on how the events are cut into calls. Windows of time without
/// events are left out.
class EventWindows {
 public:
  /// A window's events, at least one, with as many weights.
  using Take = std::function<void(std::span<const Event>, std::span<const float>)>;

  static EventWindows of_count(std::size_t events) { return {events, 0}; }
  static EventWindows of_duration(std::int64_t duration_us) { return {0, duration_us}; }

  /// Adds events in order of time, and hands on the windows that they end. `weights` are empty (all 1) or one
  /// a piece.
  void add(std::span<const Event> events, std::span<const float> weights, const Take& take);

  /// Hands on the window of time that has ended by t_us, if there is one: no event before t_us is still to
  /// come.
  void end_by(std::int64_t t_us, const Take& take);

  /// k of the window that t_us lies in. Windows of a number of events have none.
  std::int64_t index_of(std::int64_t t_us) const;

 private:
  EventWindows(std::size_t count, std::int64_t duration_us) : count_(count), duration_us_(duration_us) {}

  /// How many events, from the first on, go into the open window.
  std::size_t fitting(std::span<const Event> events) const;
  void hand_on(const Take& take);

  std::size_t count_;         ///< of a window's events, or 0
  std::int64_t duration_us_;  ///< of a window, or 0
  std::vector<Event> events_;
  std::vector<float> weights_;
};

}  // namespace esi
