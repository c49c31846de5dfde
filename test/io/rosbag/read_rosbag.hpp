#pragma once

#include <string>

#include "esi/core/error.hpp"
#include "esi/io/rosbag/reader.hpp"
#include "support/read_format.hpp"
#include "support/rosbag_file.hpp"

namespace esi::test {

inline const std::string kEvents = "/dvs/events";
inline const std::string kDvsType = "dvs_msgs/EventArray";
inline const std::string kPacketType = "event_camera_msgs/EventPacket";
inline const std::string kImageType = "sensor_msgs/Image";

inline FormatReading read_rosbag(const std::string& bytes, const ReadOptions& options = {}) {
  return read_bytes_with(open_rosbag, bytes, options);
}

/// The message of the Error that reading ends with, with "usage: " in front of usage errors; else empty.
inline std::string rosbag_error(const std::string& bytes, const std::string& stream = "") {
  ReadOptions options;
  options.stream = stream;
  try {
    read_rosbag(bytes, options);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "") + std::string(error.what());
  }
  return {};
}

/// An indexed bag of one chunk: connection 0 with messages of a type on /dvs/events.
inline std::string rosbag_of(const std::string& type, const std::vector<std::string>& messages,
                             const std::string& compression = "none") {
  const std::string connection = rosbag_connection(0, kEvents, type);
  std::string records = connection;
  for (const std::string& message : messages) records += rosbag_message(0, message);
  return rosbag_file(rosbag_chunk(compression, records), connection);
}

/// `count` events from t_us on, 10 us apart.
inline std::vector<Event> some_events(std::int64_t t_us, int count) {
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    events.push_back({t_us + 10 * i, static_cast<std::uint16_t>(i * 7 % 240),
                      static_cast<std::uint16_t>(i * 11 % 180), i % 3 == 0});
  }
  return events;
}

}  // namespace esi::test
