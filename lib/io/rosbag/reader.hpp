#pragma once

#include <memory>
#include <span>

#include "esi/io/format_reader.hpp"

namespace esi {

/// ROS 1 bags with dvs_msgs/EventArray or event_camera_msgs/EventPacket. See formats.md section 8.
bool looks_like_rosbag(std::span<const std::byte> head);
std::unique_ptr<FormatReader> open_rosbag(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace esi
