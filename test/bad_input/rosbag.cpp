#include "bad_input/bad_input.hpp"
#include "support/prophesee_file.hpp"
#include "support/recordings.hpp"
#include "support/rosbag_file.hpp"

namespace esi::test {
namespace {

const std::vector<std::string> kNone = {};
const std::string kTopic = rosbag_connection(0, "/dvs/events", "dvs_msgs/EventArray");

std::string message(int first) {
  const auto events = moving_edge(600);
  return rosbag_message(0, dvs_event_array(std::span(events).subspan(static_cast<std::size_t>(first), 100)));
}

/// Two chunks of good messages, and something between them.
std::function<std::string()> bag(const std::string& between, const std::string& compression = "none") {
  return [=] {
    return rosbag_file(
        rosbag_chunk(compression, kTopic + message(0)) + between + rosbag_chunk(compression, message(100)),
        kTopic);
  };
}

std::string packet(const std::string& encoding) {
  const auto words = words16(evt3_words(moving_edge(100)));
  const std::string topic = rosbag_connection(0, "/camera/events", "event_camera_msgs/EventPacket");
  return rosbag_file(rosbag_chunk("none", topic + rosbag_message(0, ros_event_packet(encoding, 0, words))),
                     topic);
}

}  // namespace

BadInputs bad_rosbags() {
  return {"ROS bags",
          "recording.bag",
          {
              {"chunks compressed with LZ4", 0, "", bag("", "lz4"), kNone},
              {"chunks compressed with bzip2", 1, "rosbag decompress", bag("", "bz2"), kNone},
              {"LZ4 chunk that is corrupt", 3, "corrupt_packet",
               [] {
                 const std::string chunk =
                     rosbag_record(rosbag_op(5) + rosbag_field("compression", "lz4") +
                                       rosbag_field("size", ros_number(std::uint32_t{500})),
                                   "this is not LZ4");
                 return bag(chunk)();
               },
               kNone},
              {"recorder killed: no index", 0, "",
               [] { return rosbag_file_without_index(rosbag_chunk("none", kTopic + message(0))); }, kNone},
              {"cut within a chunk", 3, "1 cut_packet",
               [] {
                 const std::string bytes =
                     rosbag_file_without_index(rosbag_chunk("none", kTopic + message(0) + message(100)));
                 return bytes.substr(0, bytes.size() - 30);
               },
               kNone},
              {"record whose length can't be", 3, "packet",
               bag(ros_number(std::uint32_t{0xFFFFFFFF}) + "rubbish"), kNone},
              {"no topic with events", 1, "topic",
               [] {
                 const std::string topic = rosbag_connection(0, "/imu", "sensor_msgs/Imu");
                 return rosbag_file(rosbag_chunk("none", topic + rosbag_message(0, "1234")), topic);
               },
               kNone},
              {"two topics with events", 2, "--stream",
               [] {
                 const std::string other = rosbag_connection(1, "/right/events", "dvs_msgs/EventArray");
                 return rosbag_file(rosbag_chunk("none", kTopic + other + message(0)), kTopic + other);
               },
               kNone},
              {"event_camera_msgs with evt3", 0, "", [] { return packet("evt3"); }, kNone},
              {"event_camera_msgs of an unknown encoding", 1, "trigger9", [] { return packet("trigger9"); },
               kNone},
              {"message that is shorter than its count of events", 3, "corrupt_packet",
               [] {
                 std::string array = dvs_event_array(moving_edge(100));
                 array.resize(array.size() - 50);
                 return bag(rosbag_chunk("none", rosbag_message(0, array)))();
               },
               kNone},
          }};
}

}  // namespace esi::test
