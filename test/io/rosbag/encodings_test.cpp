// The encodings of events in messages, byte by byte from formats.md sections 8.1 to 8.3.
#include <catch2/catch.hpp>

#include "io/rosbag/read_rosbag.hpp"
#include "support/prophesee_file.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

/// An event of libcaer: bit 0 valid, 1 polarity, 2..16 y, 17..31 x; then int32 us.
std::uint64_t libcaer_word(bool is_valid, bool on, unsigned x, unsigned y, std::uint32_t t_us) {
  const std::uint32_t address = (is_valid ? 1U : 0U) | (on ? 2U : 0U) | y << 2 | x << 17;
  return std::uint64_t{t_us} << 32 | address;
}

std::uint64_t mono_word(bool on, unsigned x, unsigned y, std::uint32_t dt_ns) {
  return std::uint64_t{on ? 1U : 0U} << 63 | std::uint64_t{y} << 48 | std::uint64_t{x} << 32 | dt_ns;
}

FormatReading read_packets(const std::vector<std::string>& packets) {
  return read_rosbag(rosbag_of(kPacketType, packets));
}

}  // namespace

TEST_CASE("dvs_msgs events keep their own times, rounded half up to microseconds") {
  const FormatReading reading =
      read_rosbag(rosbag_of(kDvsType, {dvs_event_array({{239, 179, 5, 1499, 1}, {0, 1, 5, 1500, 0}}),
                                       dvs_event_array({{2, 3, 4000000000, 999999500, 7}})}));
  const std::vector<Event> expected = {
      {5000001, 239, 179, true}, {5000002, 0, 1, false}, {4000000001000000, 2, 3, true}};
  CHECK(reading.all.events == expected);
  CHECK(reading.all.packet_ends_us == std::vector<std::int64_t>{5000003, 4000000001000001});
  CHECK(reading.header.sensor == SensorSize{240, 180});
  CHECK(reading.header.layout == "ROS bag, /dvs/events dvs_msgs/EventArray");
  CHECK(reading.header.has_packets);
  CHECK_FALSE(reading.header.has_intensity_frames);
  CHECK(reading.losses.text().empty());
  CHECK(reading.notes().empty());
}

TEST_CASE("evt words are one stream over a bag's messages") {
  const FormatReading evt3 =
      read_packets({ros_event_packet("evt3", 0, words16({0x2001, 0x8002, 0x6003, 0x0004})),
                    ros_event_packet("evt3", 0, words16({0x2805})), ros_event_packet("evt3", 0, ""),
                    ros_event_packet("evt3", 0, words16({0x6004, 0x2806}))});
  CHECK(evt3.all.events == std::vector<Event>{{8195, 5, 4, true}, {8196, 6, 4, true}});
  CHECK(evt3.all.packet_ends_us == std::vector<std::int64_t>{8196, 8197});
  CHECK_THAT(evt3.notes(), Contains("1 events before the first time word"));
  CHECK(evt3.losses.text().empty());

  const FormatReading evt2 =
      read_packets({ros_event_packet("evt2", 0, words32({evt2_word(8, 1)})),
                    ros_event_packet("evt2", 0, words32({evt2_event({3, 4, 5, true})}))});
  CHECK(evt2.all.events == std::vector<Event>{{67, 4, 5, true}});
  const FormatReading evt21 = read_packets(
      {ros_event_packet("evt21", 0, words64({evt21_time_high(64), evt21_word(0, 3, 32, 5, 2)}))});
  CHECK(evt21.all.events == std::vector<Event>{{67, 33, 5, false}});
}

TEST_CASE("libcaer events count from the message's base time, and over its wrap") {
  const FormatReading reading = read_packets(
      {ros_event_packet("libcaer", 1000000499,
                        words64({libcaer_word(true, true, 239, 179, 7), libcaer_word(false, true, 1, 1, 8),
                                 libcaer_word(true, false, 0x7FFF, 0x7FFF, 0x7FFF'FFFF),
                                 libcaer_word(true, true, 1, 2, 5)})),
       ros_event_packet("libcaer", 9000000000500, words64({libcaer_word(true, true, 1, 2, 3)}))});
  const std::vector<Event> expected = {{1000007, 239, 179, true},
                                       {std::int64_t{1000000} + 0x7FFF'FFFF, 0x7FFF, 0x7FFF, false},
                                       {1000000 + 0x8000'0000 + 5, 1, 2, true},
                                       {9000000001 + 3, 1, 2, true}};
  CHECK(reading.all.events == expected);
}

TEST_CASE("libcaer_cmp words change time, column and row, and begin anew in each message") {
  const FormatReading reading =
      read_packets({ros_event_packet("libcaer_cmp", 5000000,
                                     words16({
                                         0x3003,                  // an event at 0, 3
                                         0x0001, 0x1002, 0x2064,  // 4096 + 2 us, x 100
                                         0x3805,                  // ON at y 5
                                         0x4806, 0x5081, 0x5003,  // ON vectors from y 6, 14 on
                                         0x6FFF, 0xFFFF,          // skipped
                                         0x4007, 0x5001,          // OFF
                                     })),
                    ros_event_packet("libcaer_cmp", 7000000, words16({0x5003, 0x3001}))});
  const std::vector<Event> expected = {{5000, 0, 3, false},   {9098, 100, 5, true},  {9098, 100, 6, true},
                                       {9098, 100, 13, true}, {9098, 100, 14, true}, {9098, 100, 15, true},
                                       {9098, 100, 7, false}, {7000, 0, 0, false},   {7000, 0, 1, false},
                                       {7000, 0, 1, false}};
  CHECK(reading.all.events == expected);
}

TEST_CASE("mono words have nanoseconds from the message's base time on") {
  const FormatReading reading = read_packets(
      {ros_event_packet("mono", 5000600,
                        words64({mono_word(true, 0xFFFF, 0x7FFF, 899), mono_word(false, 1, 2, 900),
                                 mono_word(true, 3, 4, 0xFFFF'FFFF)}))});
  const std::vector<Event> expected = {
      {5001, 0xFFFF, 0x7FFF, true}, {5002, 1, 2, false}, {5000 + 4294968, 3, 4, true}};
  CHECK(reading.all.events == expected);
}

TEST_CASE("events of a bag that can't be decoded are an error that names the encoding") {
  const auto [packet, message] = GENERATE(table<std::string, const char*>({
      {ros_event_packet("trigger", 0, "1234"), "encoded as 'trigger'"},
      {ros_event_packet("", 0, "1234"), "encoded as ''"},
      {ros_event_packet("a\nb\xFF", 0, "1234"), "encoded as 'a?b?'"},
      {ros_event_packet("mono", 0, "12345678", {240, 180}, true), "big-endian"},
      {ros_event_packet("mono", 0, "1234"), "4 bytes, which is no multiple of 8"},
  }));
  CHECK_THAT(rosbag_error(rosbag_of(kPacketType, {packet})), Contains(message) && Contains("of /dvs/events"));
  // Among readable messages it is one damaged message.
  const std::string good = ros_event_packet("mono", 0, words64({mono_word(true, 1, 2, 3000)}));
  const FormatReading reading = read_packets({good, packet, packet, good});
  CHECK(reading.all.events.size() == 2);
  CHECK(reading.losses.text() == "2 corrupt_packet");
  CHECK(reading.header.notes.size() == 1);
}

TEST_CASE("a bag's sensor size is empty where its messages have no possible one") {
  const SensorSize size =
      GENERATE(SensorSize{0, 180}, SensorSize{240, 0}, SensorSize{-1, 180}, SensorSize{65537, 1});
  CHECK_FALSE(read_rosbag(rosbag_of(kDvsType, {dvs_event_array({{1, 2, 3, 4, 1}}, size)})).header.sensor);
}

}  // namespace esi::test
