#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "esi/core/frame.hpp"

namespace esi {

/// A sensor_msgs/Image of 8 or 16 bits grey or of 8-bit colour, which is made grey, at its header's stamp:
/// the exposure is empty. Nothing where the message is damaged or has another encoding.
std::optional<IntensityFrame> decode_ros_image(std::span<const std::byte> message);

}  // namespace esi
