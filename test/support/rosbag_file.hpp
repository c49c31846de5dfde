#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "esi/core/event.hpp"

namespace esi::test {

/// A number's bytes as they are stored, little-endian.
template <class Number>
std::string ros_number(Number value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A text or array with its length in front.
std::string ros_array(std::string_view bytes);

/// The field `name=value` with its length in front.
std::string rosbag_field(std::string_view name, std::string_view value);

/// A record of header fields and data.
std::string rosbag_record(std::string_view fields, std::string_view data);
/// Its op alone.
std::string rosbag_op(std::uint8_t op);

std::string rosbag_connection(std::uint32_t id, std::string_view topic, std::string_view type);
std::string rosbag_message(std::uint32_t id, std::string_view data);
/// `compression` is "none" or "lz4", which compresses `records`; others store them as they are.
std::string rosbag_chunk(std::string_view compression, std::string_view records);

/// std_msgs/Header.
std::string ros_header(std::uint32_t seconds, std::uint32_t nanoseconds);
/// dvs_msgs/EventArray. Times are nanoseconds, so that tests can round.
struct DvsEvent {
  std::uint16_t x = 0, y = 0;
  std::uint32_t seconds = 0, nanoseconds = 0;
  std::uint8_t polarity = 0;
};
std::string dvs_event_array(const std::vector<DvsEvent>& events, SensorSize size = {240, 180});
std::string dvs_event_array(std::span<const Event> events);
/// event_camera_msgs/EventPacket.
std::string ros_event_packet(std::string_view encoding, std::uint64_t time_base_ns, std::string_view words,
                             SensorSize size = {240, 180}, bool is_bigendian = false);
/// sensor_msgs/Image.
struct RosImage {
  std::uint32_t seconds = 0, nanoseconds = 0;
  std::uint32_t width = 240, height = 180;
  std::string encoding = "mono8";
  std::uint8_t is_bigendian = 0;
  std::uint32_t row_bytes = 240;
  std::string pixels;
};
std::string ros_image(const RosImage& image);

/// A bag of the given records, such as chunks: header, records, and an index with the connections that
/// `connections` holds.
std::string rosbag_file(std::string_view records, std::string_view connections);
/// One whose recorder was killed: no index.
std::string rosbag_file_without_index(std::string_view records);

/// A small whole bag with events of a sensor of 240x180 px as dvs_msgs/EventArray.
std::string rosbag_recording(std::span<const Event> events);

}  // namespace esi::test
