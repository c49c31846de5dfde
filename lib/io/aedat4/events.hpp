#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// The events of one AEDAT 4 packet as they are stored; they stay in the FlatBuffer that they come from.
class Aedat4Events {
 public:
  Aedat4Events() = default;

  /// Of a size-prefixed FlatBuffer. Empty where that does not verify as an event packet.
  static std::optional<Aedat4Events> in(std::span<const std::byte> flatbuffer);

  bool empty() const { return records_.empty(); }
  /// Where this packet ends (half-open): its last event's time + 1. Only where it is not empty.
  std::int64_t end_us() const;

  /// Moves up to `count` events from the front to `events`; returns how many of them were left out because a
  /// coordinate is negative.
  std::size_t move_to(std::vector<Event>& events, std::size_t count);

 private:
  std::span<const std::byte> records_;
};

}  // namespace esi
