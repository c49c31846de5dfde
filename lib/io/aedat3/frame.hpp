#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"
#include "esi/io/aedat3/packets.hpp"

namespace esi {

/// The image of one frame event, colour made grey, CV_16UC1 over the full 16 bits. Where it shows a part of
/// the sensor, the rest of the image is zero. `is_damaged` tells why it is empty: fewer pixels than it
/// claims, or a place outside the sensor; otherwise the camera marked it as invalid.
struct Aedat3Frame {
  std::optional<IntensityFrame> frame;
  bool is_damaged = false;
};

Aedat3Frame decode_aedat3_frame(const Aedat3Packet& packet, std::span<const std::byte> event,
                                std::optional<SensorSize> sensor);

}  // namespace esi
