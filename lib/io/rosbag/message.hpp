#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include "esi/core/event.hpp"

namespace esi {

/// The fields of a ROS 1 message, one after the other: little-endian, packed. Once something is missing, all
/// further fields are empty or 0.
class RosMessage {
 public:
  explicit RosMessage(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class Number>
  Number number() {
    Number value{};
    const auto field = bytes(sizeof value);
    if (!field.empty()) std::memcpy(&value, field.data(), sizeof value);
    return value;
  }

  std::span<const std::byte> bytes(std::size_t count);
  /// With its length in front.
  std::span<const std::byte> array() { return bytes(number<std::uint32_t>()); }
  std::string_view text();
  /// std_msgs/Header; returns its stamp.
  std::int64_t header_us();

  /// Whether all fields were there, and nothing is left.
  bool is_whole() const { return !is_cut_ && rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool is_cut_ = false;
};

/// ROS seconds and nanoseconds as whole microseconds, rounded half up.
std::int64_t us_from_ros_time(std::uint32_t seconds, std::uint32_t nanoseconds);

/// A message with events, still encoded.
struct RosEvents {
  std::optional<SensorSize> sensor;
  std::string_view encoding;        ///< of EventPacket, such as "evt3"; kDvsEncoding of EventArray
  std::uint64_t time_base_ns = 0;   ///< of EventPacket
  bool is_bigendian = false;        ///< of EventPacket
  std::span<const std::byte> data;  ///< of the message
};

inline constexpr std::string_view kDvsEncoding = "dvs_msgs/EventArray";

/// dvs_msgs/EventArray. Empty where it is damaged.
std::optional<RosEvents> parse_event_array(std::span<const std::byte> message);
/// event_camera_msgs/EventPacket and event_array_msgs/EventArray. Empty where it is damaged.
std::optional<RosEvents> parse_event_packet(std::span<const std::byte> message);

}  // namespace esi
