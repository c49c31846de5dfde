// A real bag against numbers that another parser found.
#include <catch2/catch.hpp>

#include "esi/io/event_digest.hpp"
#include "esi/io/event_source.hpp"
#include "io/rosbag/read_rosbag.hpp"
#include "support/scripted_reader.hpp"
#include "support/shared_data.hpp"

namespace esi::test {

TEST_CASE("the real bag has the digest that another parser found") {
  const auto path = shared_data("ros/test_events_1.bag");
  if (!path) return;
  const auto check = [](const EventDigest& digest) {
    CHECK(digest.events() == 343474);
    CHECK(digest.duration_us() == 2078178);
    CHECK(digest.sum_x() == 116731888);
    CHECK(digest.sum_y() == 80879209);
    CHECK(digest.on() == 125183);
    CHECK(digest.crc32() == "551f79e4");
  };
  const FormatReading reading = read_with(open_rosbag, *path);
  EventDigest digest;
  digest.add(reading.all.events);
  check(digest);
  CHECK(digest.t_first_us() == 7139845);
  CHECK(reading.header.sensor == SensorSize{640, 480});
  CHECK(reading.header.layout == "ROS bag, /event_camera/events evt3");
  REQUIRE(reading.all.packet_ends_us.size() == 517);
  CHECK(reading.all.packet_ends_us.front() == 7142057);
  CHECK(reading.all.packet_ends_us.back() == 9218024);
  CHECK(reading.losses.text().empty());
  CHECK(reading.notes().empty());
  CHECK(reading.most_events_at_once < 3 * kPacketEvents);

  EventDigest gated;
  const auto source = open_recording(*path, {});
  gated.add(drain(*source).events);
  check(gated);
  CHECK_FALSE(source->losses().any());
}

TEST_CASE("a real bag without its index gives the same events") {
  const auto path = shared_data("ros/test_events_1.bag");
  if (!path) return;
  constexpr std::size_t index_pos = 2315444;  // read off the file by hand
  std::string bytes = content_of(*path).substr(0, index_pos);
  const std::size_t field = bytes.find("index_pos=") + 10;
  REQUIRE(bytes.substr(field, 8) == ros_number(std::uint64_t{index_pos}));
  bytes.replace(field, 8, std::string(8, '\0'));
  const FormatReading reading = read_rosbag(bytes);
  EventDigest digest;
  digest.add(reading.all.events);
  CHECK(digest.crc32() == "551f79e4");
  CHECK(reading.losses.text() == "1 missing_table");
}

TEST_CASE("a bag gives back its events") {
  const std::vector<Event> events = some_events(0, 5000);
  const FormatReading reading = read_rosbag(rosbag_recording(events));
  CHECK(reading.all.events == events);
  CHECK(reading.header.sensor == SensorSize{240, 180});
  CHECK(reading.losses.text().empty());
  CHECK(read_rosbag(rosbag_recording({})).all.events.empty());
}

}  // namespace esi::test
