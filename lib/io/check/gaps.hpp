#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/time.hpp"

namespace esi {

/// The longest pauses between successive events.
class Gaps {
 public:
  /// How many are kept.
  static constexpr std::size_t kMost = 20;

  void add(std::span<const Event> events);

  /// Those longer than `limit_us`, in order of time, from the event before the pause to the one after it.
  std::vector<Interval> longer_than(std::int64_t limit_us) const;

 private:
  std::vector<Interval> longest_;  ///< a heap, the shortest on top
  std::optional<std::int64_t> previous_us_;
};

}  // namespace esi
