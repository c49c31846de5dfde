#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"

namespace esi {

/// About how many events a packet holds: few enough to stay in the L2 cache beside the pixels' state.
inline constexpr std::size_t kPacketEvents = 8192;

/// A reusable piece of a recording.
struct Packet {
  std::vector<Event> events;
  std::vector<IntensityFrame> frames;        ///< in order of the exposures' ends
  std::vector<std::int64_t> packet_ends_us;  ///< where the file's own packets end (half-open), if it has any

  void clear() {
    events.clear();
    frames.clear();
    packet_ends_us.clear();
  }
};

}  // namespace esi
