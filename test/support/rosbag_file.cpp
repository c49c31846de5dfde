#include "support/rosbag_file.hpp"

#include <lz4frame.h>

#include <algorithm>

namespace esi::test {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::size_t kHeaderRecordBytes = 4096;

std::string header_record(std::uint64_t index_pos) {
  const std::string fields = rosbag_op(3) + rosbag_field("index_pos", ros_number(index_pos)) +
                             rosbag_field("conn_count", ros_number(std::uint32_t{1})) +
                             rosbag_field("chunk_count", ros_number(std::uint32_t{1}));
  return rosbag_record(fields, std::string(kHeaderRecordBytes - 8 - fields.size(), ' '));
}

std::string lz4_frame(std::string_view bytes) {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
  preferences.frameInfo.blockMode = LZ4F_blockIndependent;  // as roslz4 does
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string out(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences));
  return out;
}

}  // namespace

std::string ros_array(std::string_view bytes) {
  return ros_number(static_cast<std::uint32_t>(bytes.size())).append(bytes);
}

std::string rosbag_field(std::string_view name, std::string_view value) {
  return ros_array(std::string(name) + "=" + std::string(value));
}

std::string rosbag_record(std::string_view fields, std::string_view data) {
  return ros_array(fields) + ros_array(data);
}

std::string rosbag_op(std::uint8_t op) { return rosbag_field("op", ros_number(op)); }

std::string rosbag_connection(std::uint32_t id, std::string_view topic, std::string_view type) {
  return rosbag_record(rosbag_op(7) + rosbag_field("conn", ros_number(id)) + rosbag_field("topic", topic),
                       rosbag_field("topic", topic) + rosbag_field("type", type) +
                           rosbag_field("md5sum", "8a6101b351a64529ac77bd8b71074e52") +
                           rosbag_field("message_definition", "uint8 a=1"));
}

std::string rosbag_message(std::uint32_t id, std::string_view data) {
  return rosbag_record(
      rosbag_op(2) + rosbag_field("conn", ros_number(id)) + rosbag_field("time", std::string(8, '\1')), data);
}

std::string rosbag_chunk(std::string_view compression, std::string_view records) {
  return rosbag_record(rosbag_op(5) + rosbag_field("compression", compression) +
                           rosbag_field("size", ros_number(static_cast<std::uint32_t>(records.size()))),
                       compression == "lz4" ? lz4_frame(records) : std::string(records));
}

std::string ros_header(std::uint32_t seconds, std::uint32_t nanoseconds) {
  return ros_number(std::uint32_t{7}) + ros_number(seconds) + ros_number(nanoseconds) + ros_array("camera");
}

std::string dvs_event_array(const std::vector<DvsEvent>& events, SensorSize size) {
  std::string data = ros_header(1, 0) + ros_number(size.height_px) + ros_number(size.width_px) +
                     ros_number(static_cast<std::uint32_t>(events.size()));
  for (const DvsEvent& event : events) {
    data += ros_number(event.x) + ros_number(event.y) + ros_number(event.seconds) +
            ros_number(event.nanoseconds) + ros_number(event.polarity);
  }
  return data;
}

std::string dvs_event_array(std::span<const Event> events) {
  std::vector<DvsEvent> stored(events.size());
  std::transform(events.begin(), events.end(), stored.begin(), [](const Event& event) {
    return DvsEvent{event.x, event.y, static_cast<std::uint32_t>(event.t_us / 1000000),
                    static_cast<std::uint32_t>(event.t_us % 1000000 * 1000),
                    static_cast<std::uint8_t>(event.on)};
  });
  return dvs_event_array(stored);
}

std::string ros_event_packet(std::string_view encoding, std::uint64_t time_base_ns, std::string_view words,
                             SensorSize size, bool is_bigendian) {
  return ros_header(1, 0) + ros_number(size.height_px) + ros_number(size.width_px) +
         ros_number(std::uint64_t{3}) + ros_number(time_base_ns) + ros_array(encoding) +
         ros_number(static_cast<std::uint8_t>(is_bigendian)) + ros_array(words);
}

std::string ros_image(const RosImage& image) {
  return ros_header(image.seconds, image.nanoseconds) + ros_number(image.height) + ros_number(image.width) +
         ros_array(image.encoding) + ros_number(image.is_bigendian) + ros_number(image.row_bytes) +
         ros_array(image.pixels);
}

std::string rosbag_file(std::string_view records, std::string_view connections) {
  const std::size_t index = kMagic.size() + kHeaderRecordBytes + records.size();
  const std::string chunk_info =
      rosbag_record(rosbag_op(6) + rosbag_field("ver", ros_number(std::uint32_t{1})), "12345678");
  return std::string(kMagic)
      .append(header_record(index))
      .append(records)
      .append(connections)
      .append(chunk_info);
}

std::string rosbag_file_without_index(std::string_view records) {
  return std::string(kMagic).append(header_record(0)).append(records);
}

std::string rosbag_recording(std::span<const Event> events) {
  constexpr std::size_t kMessageEvents = 400;
  const std::string connection = rosbag_connection(0, "/dvs/events", "dvs_msgs/EventArray");
  std::string records;
  bool is_first = true;
  while (is_first || !events.empty()) {
    const auto message = events.first(std::min(kMessageEvents, events.size()));
    events = events.subspan(message.size());
    records +=
        rosbag_chunk("none", (is_first ? connection : "") + rosbag_message(0, dvs_event_array(message)));
    records +=
        rosbag_record(rosbag_op(4) + rosbag_field("conn", ros_number(std::uint32_t{0})), "12 bytes ...");
    is_first = false;
  }
  return rosbag_file(records, connection);
}

}  // namespace esi::test
