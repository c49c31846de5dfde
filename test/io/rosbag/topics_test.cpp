#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "io/rosbag/read_rosbag.hpp"
#include "support/prophesee_file.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

struct Topic {
  std::string name, type;
  std::string message;
};

/// A bag with one chunk per topic; the connections stand in the chunks and in the index.
std::string bag_of(const std::vector<Topic>& topics, bool has_index = true) {
  std::string records, connections;
  std::uint32_t id = 3;
  for (const Topic& topic : topics) {
    const std::string connection = rosbag_connection(id, topic.name, topic.type);
    records +=
        rosbag_chunk("none", connection + (topic.message.empty() ? "" : rosbag_message(id, topic.message)));
    connections += connection;
    ++id;
  }
  return has_index ? rosbag_file(records, connections) : rosbag_file_without_index(records);
}

const std::string kLeft = dvs_event_array({{1, 2, 3, 0, 1}});
const std::string kRight = dvs_event_array({{4, 5, 6, 0, 1}});
const std::vector<Topic> kStereo = {{"/imu", "sensor_msgs/Imu", "anything"},
                                    {"/davis/left/events", kDvsType, kLeft},
                                    {"/davis/right/events", "event_array_msgs/EventArray",
                                     ros_event_packet("mono", 6000000000, std::string(8, '\0'))}};

std::string whole_image() { return std::string(240 * 180, '\x42'); }

RosImage image() {
  RosImage image;
  image.seconds = 7;
  image.nanoseconds = 1500;
  image.pixels = whole_image();
  return image;
}

}  // namespace

TEST_CASE("the stream option chooses among a bag's event topics") {
  const bool has_index = GENERATE(true, false);
  ReadOptions options;
  options.stream = "/davis/right/events";
  const FormatReading reading = read_rosbag(bag_of(kStereo, has_index), options);
  CHECK(reading.all.events == std::vector<Event>{{6000000, 0, 0, false}});
  CHECK(reading.header.notes.size() == (has_index ? 0 : 1));
  options.stream = "/davis/left/events";
  CHECK(read_rosbag(bag_of(kStereo, has_index), options).all.events ==
        std::vector<Event>{{3000000, 1, 2, true}});

  CHECK_THAT(rosbag_error(bag_of(kStereo, has_index), "/davis/events"),
             Contains("usage: ") && Contains("'/davis/events' is none of its event topics") &&
                 Contains("/davis/left/events, /davis/right/events"));
}

TEST_CASE("several event topics without a choice are a usage error, where the index tells them all") {
  CHECK_THAT(rosbag_error(bag_of(kStereo)), Contains("usage: ") && Contains("--stream") &&
                                                Contains("/davis/left/events, /davis/right/events"));
  const FormatReading reading = read_rosbag(bag_of(kStereo, false));
  CHECK(reading.all.events == std::vector<Event>{{3000000, 1, 2, true}});
  CHECK_THAT(reading.notes(), Contains("topic /davis/left/events are read, the first one met") &&
                                  Contains("further event topics") && Contains("The recorder was stopped"));
  CHECK(reading.losses.text() == "1 missing_table");
}

TEST_CASE("a bag without events is an error that lists its topics") {
  const bool has_index = GENERATE(true, false);
  const std::string stream = GENERATE("", "/imu");
  const std::string bag =
      bag_of({{"/imu", "sensor_msgs/Imu", "x"}, {"/tf", "tf2_msgs/TFMessage", "x"}}, has_index);
  const std::string message = rosbag_error(bag, stream);
  CHECK_THAT(message,
             Contains("no event topic") && Contains("/imu (sensor_msgs/Imu), /tf (tf2_msgs/TFMessage)"));
  CHECK_FALSE(Catch::Matchers::StartsWith("usage").match(message));
  CHECK_THAT(rosbag_error(bag_of({}, has_index)), Contains("no topic can be found"));
}

TEST_CASE("connections of one topic are one stream") {
  const FormatReading reading =
      read_rosbag(bag_of({{kEvents, kDvsType, kLeft}, {kEvents, kDvsType, kRight}}));
  CHECK(reading.all.events.size() == 2);
}

TEST_CASE("images of the events' camera become intensity frames at their stamp") {
  struct Row {
    std::string encoding;
    std::string pixel;
    int type;
    double grey;
    std::uint8_t is_bigendian = 0;
  };
  using namespace std::string_literals;
  const auto row =
      GENERATE(Row{"mono8", "\x42", CV_8UC1, 0x42}, Row{"8UC1", "\x42", CV_8UC1, 0x42},
               Row{"mono16", "\x34\x12", CV_16UC1, 0x1234}, Row{"mono16", "\x34\x12", CV_16UC1, 0x3412, 1},
               Row{"16UC1", "\x34\x12", CV_16UC1, 0x1234}, Row{"bgr8", "\xff\x00\x00"s, CV_8UC1, 29},
               Row{"rgb8", "\xff\x00\x00"s, CV_8UC1, 76}, Row{"bgra8", "\xff\x00\x00\x07"s, CV_8UC1, 29},
               Row{"rgba8", "\xff\x00\x00\x07"s, CV_8UC1, 76});
  CAPTURE(row.encoding);
  RosImage stored = image();
  stored.encoding = row.encoding;
  stored.is_bigendian = row.is_bigendian;
  stored.row_bytes = static_cast<std::uint32_t>(240 * row.pixel.size() + 4);  // padded
  stored.pixels.clear();
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 240; ++x) stored.pixels += row.pixel;
    stored.pixels += "\x99\x99\x99\x99";
  }
  const bool image_first = GENERATE(true, false);
  const Topic events{kEvents, kDvsType, kLeft}, images{"/dvs/image_raw", kImageType, ros_image(stored)};
  const FormatReading reading =
      read_rosbag(bag_of(image_first ? std::vector{images, events} : std::vector{events, images}));
  CHECK(reading.all.events.size() == 1);
  REQUIRE(reading.all.frames.size() == 1);
  CHECK(reading.all.frames[0].exposure == Interval{7000002, 7000002});
  const cv::Mat& got = reading.all.frames[0].image;
  REQUIRE(got.type() == row.type);
  CHECK(cv::norm(got, cv::Mat(180, 240, row.type, cv::Scalar(row.grey)), cv::NORM_INF) == 0);
  CHECK(reading.header.has_intensity_frames);
  CHECK(reading.losses.text().empty());
  CHECK(reading.notes().empty());
}

TEST_CASE("only the camera's own images are taken") {
  const std::string message = ros_image(image());
  struct Row {
    std::vector<std::string> topics;
    bool has_frames;
  };
  const auto row =
      GENERATE(Row{{"/dvs/image_raw"}, true}, Row{{"/dvs/image"}, true}, Row{{"/left/image_raw"}, false},
               Row{{"/dvs/left/image_raw"}, false}, Row{{"/image_raw"}, false});
  std::vector<Topic> topics = {{kEvents, kDvsType, kLeft}};
  for (const std::string& topic : row.topics) topics.push_back({topic, kImageType, message});
  CAPTURE(row.topics);
  const FormatReading reading = read_rosbag(bag_of(topics));
  CHECK(reading.all.frames.size() == (row.has_frames ? 1 : 0));
  CHECK(reading.header.has_intensity_frames == row.has_frames);

  RosImage rendered = image();
  rendered.seconds = 8;
  const FormatReading both = read_rosbag(bag_of({{"/dvs/a_rendering", kImageType, ros_image(rendered)},
                                                 {"/dvs/image_raw", kImageType, message},
                                                 {kEvents, kDvsType, kLeft}}));
  REQUIRE(both.all.frames.size() == 1);
  CHECK(both.all.frames[0].exposure.begin_us == 7000002);
}

TEST_CASE("images that can't be right are counted, and the events go on") {
  const auto change = GENERATE(table<const char*, void (*)(RosImage&)>({
      {"a pixel too few", [](RosImage& i) { i.pixels.pop_back(); }},
      {"a pixel too many", [](RosImage& i) { i.pixels += ' '; }},
      {"rows too short", [](RosImage& i) { i.row_bytes = 239; }},
      {"no width", [](RosImage& i) { i.width = 0; }},
      {"no height",
       [](RosImage& i) {
         i.height = 0;
         i.pixels.clear();
       }},
      {"sides that overflow", [](RosImage& i) { i.width = i.height = i.row_bytes = 0xFFFF'FFFF; }},
      {"an unknown encoding", [](RosImage& i) { i.encoding = "bayer_rggb8"; }},
      {"16 bits at odd rows",
       [](RosImage& i) {
         i.encoding = "mono16";
         i.width = 100;
         i.row_bytes = 241;
         i.pixels.resize(241 * 180);
       }},
  }));
  CAPTURE(std::get<0>(change));
  RosImage stored = image();
  std::get<1>(change)(stored);
  const FormatReading reading =
      read_rosbag(bag_of({{"/dvs/image_raw", kImageType, ros_image(stored)}, {kEvents, kDvsType, kLeft}}));
  CHECK(reading.all.frames.empty());
  CHECK(reading.all.events.size() == 1);
  CHECK(reading.losses.text() == "1 unreadable_frame");
  CHECK_THAT(reading.notes(), Contains("is damaged, or neither grey"));
}

TEST_CASE("images of another size or clock than the events are left out, and that is said") {
  RosImage small = image();
  small.width = small.row_bytes = 120;
  small.height = 360;
  const std::string evt3 = ros_event_packet("evt3", 0, words16({0x8001, 0x2001}));
  const auto [events, picture, message] = GENERATE_COPY(table<Topic, RosImage, const char*>(
      {{{kEvents, kDvsType, kLeft}, small, "not of the events' sensor size"},
       {{kEvents, kPacketType, evt3}, image(), "the events those of their camera"}}));
  const FormatReading reading =
      read_rosbag(bag_of({{"/dvs/image_raw", kImageType, ros_image(picture)}, events}));
  CHECK(reading.all.frames.empty());
  CHECK(reading.all.events.size() == 1);
  CHECK_THAT(reading.notes(), Contains("The images of /dvs/image_raw are left out") && Contains(message));
  CHECK(reading.losses.text().empty());
}

TEST_CASE("any number of images may come before a bag's first events") {
  std::string records =
      rosbag_connection(0, kEvents, kDvsType) + rosbag_connection(1, "/dvs/image_raw", kImageType);
  const std::string connections = records;
  RosImage tiny;
  tiny.width = tiny.height = tiny.row_bytes = 1;
  tiny.pixels = "x";
  for (int i = 0; i < 200; ++i) records += rosbag_message(1, ros_image(tiny));
  records += rosbag_message(0, dvs_event_array({{0, 0, 1, 0, 1}}, {1, 1}));
  const FormatReading reading = read_rosbag(rosbag_file(rosbag_chunk("none", records), connections));
  CHECK(reading.all.frames.size() == 200);
  CHECK(reading.all.events.size() == 1);
}

}  // namespace esi::test
