#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"

namespace esi {

/// The image of one AEDAT 4 packet (a size-prefixed FlatBuffer), colour made grey. Where it shows a part of
/// the sensor, the rest of the image is zero. Empty where the FlatBuffer does not verify, has fewer pixels
/// than it claims or an unknown pixel format, or lies outside the sensor.
std::optional<IntensityFrame> decode_aedat4_frame(std::span<const std::byte> flatbuffer,
                                                  std::optional<SensorSize> sensor);

}  // namespace esi
