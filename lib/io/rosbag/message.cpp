#include "esi/io/rosbag/message.hpp"

namespace esi {
namespace {

constexpr std::uint64_t kDvsEventBytes = 13;

std::optional<SensorSize> take_size(RosMessage& message) {
  const auto height = message.number<std::uint32_t>();
  const auto width = message.number<std::uint32_t>();
  if (width < 1 || height < 1 || width > kMaxSensorSide_px || height > kMaxSensorSide_px) return std::nullopt;
  return SensorSize{static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

std::span<const std::byte> RosMessage::bytes(std::size_t count) {
  is_cut_ = is_cut_ || count > rest_.size();
  if (is_cut_) return {};
  const auto field = rest_.first(count);
  rest_ = rest_.subspan(count);
  return field;
}

std::string_view RosMessage::text() {
  const auto field = array();
  return {reinterpret_cast<const char*>(field.data()), field.size()};
}

std::int64_t RosMessage::header_us() {
  number<std::uint32_t>();  // seq
  const auto seconds = number<std::uint32_t>();
  const auto nanoseconds = number<std::uint32_t>();
  array();  // frame_id
  return us_from_ros_time(seconds, nanoseconds);
}

std::int64_t us_from_ros_time(std::uint32_t seconds, std::uint32_t nanoseconds) {
  return std::int64_t{seconds} * 1'000'000 + (std::int64_t{nanoseconds} + 500) / 1000;
}

std::optional<RosEvents> parse_event_array(std::span<const std::byte> bytes) {
  RosMessage message(bytes);
  RosEvents events;
  message.header_us();
  events.sensor = take_size(message);
  events.encoding = kDvsEncoding;
  events.data = message.bytes(message.number<std::uint32_t>() * kDvsEventBytes);
  if (!message.is_whole()) return std::nullopt;
  return events;
}

std::optional<RosEvents> parse_event_packet(std::span<const std::byte> bytes) {
  RosMessage message(bytes);
  RosEvents events;
  message.header_us();
  events.sensor = take_size(message);
  message.number<std::uint64_t>();  // seq
  events.time_base_ns = message.number<std::uint64_t>();
  events.encoding = message.text();
  events.is_bigendian = message.number<std::uint8_t>() != 0;
  events.data = message.array();
  if (!message.is_whole()) return std::nullopt;
  return events;
}

}  // namespace esi
