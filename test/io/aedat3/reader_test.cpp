#include "esi/io/aedat3/reader.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "esi/io/event_source.hpp"
#include "io/aedat3/read_aedat3.hpp"
#include "support/scripted_reader.hpp"

namespace esi::test {
namespace {

std::string as_bytes(std::initializer_list<unsigned> values) {
  std::string bytes;
  for (const unsigned value : values) bytes += static_cast<char>(value);
  return bytes;
}

}  // namespace

TEST_CASE("AEDAT 3.1 written out byte by byte gives its events") {
  const std::string packet = as_bytes({
      0x01, 0x00, 0x01, 0x00,                          // polarity, source 1
      0x08, 0x00, 0x00, 0x00,                          // 8 bytes an event
      0x04, 0x00, 0x00, 0x00,                          // the time is at 4
      0x02, 0x00, 0x00, 0x00,                          // 2 << 31 us
      0x03, 0x00, 0x00, 0x00,                          // capacity
      0x03, 0x00, 0x00, 0x00,                          // events
      0x02, 0x00, 0x00, 0x00,                          // valid ones
      0x07, 0x00, 0x0A, 0x00, 0xE8, 0x03, 0x00, 0x00,  // x 5, y 1, ON, 1000 us
      0xCC, 0x02, 0xDE, 0x01, 0xE9, 0x03, 0x00, 0x00,  // invalid
      0xCD, 0x02, 0xDE, 0x01, 0xEA, 0x03, 0x00, 0x00,  // x 239, y 179, OFF, 1002 us
  });
  const FormatReading content = read_aedat3_bytes(aedat3_davis_header() + packet);
  const std::int64_t upper_us = std::int64_t{2} << 31;
  CHECK(content.all.events ==
        std::vector<Event>{{upper_us + 1000, 5, 1, true}, {upper_us + 1002, 239, 179, false}});
  CHECK(content.all.packet_ends_us == std::vector<std::int64_t>{upper_us + 1003});
  CHECK(content.header.sensor == SensorSize{240, 180});
  CHECK(content.header.format == "aedat3");
  CHECK(content.header.layout == "AEDAT 3.1, RAW, DAVIS240C");
  CHECK(content.header.has_packets);
  CHECK(content.header.has_intensity_frames);
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("Large AEDAT 3.1 packets come in bounded pieces, their ends with their last events") {
  const auto first = some_aedat3_events(1000, 10'000);
  const auto second = some_aedat3_events(200'000, 40'000);
  const FormatReading content =
      read_aedat3_bytes(aedat3_davis_header() + aedat3_packet(first) + aedat3_packet(second));
  auto expected = first;
  expected.insert(expected.end(), second.begin(), second.end());
  CHECK(content.all.events == expected);
  CHECK(content.most_events_at_once == kPacketEvents);
  CHECK(content.all.packet_ends_us == std::vector<std::int64_t>{100'991, 599'991});
}

TEST_CASE("AEDAT 3.1 packets of other types, other sources and without events are passed over") {
  const auto first = some_aedat3_events(1000, 5);
  const auto last = some_aedat3_events(2000, 5);
  const auto type = GENERATE(as<std::int16_t>{}, 0, 3, 4, 5, 7, 12, 99, INT16_MAX);
  Aedat3Head empty;
  empty.event_bytes = GENERATE(0, 8, 1000);
  const std::string bytes = aedat3_davis_header() + aedat3_head(empty) + aedat3_packet(first) +
                            aedat3_packet(some_aedat3_events(1500, 3), 1, type) +
                            aedat3_packet(some_aedat3_events(1700, 9), 2) + aedat3_head(empty) +
                            aedat3_packet(last);
  const FormatReading content = read_aedat3_bytes(bytes);
  auto expected = first;
  expected.insert(expected.end(), last.begin(), last.end());
  CHECK(content.all.events == expected);
  CHECK(content.all.packet_ends_us == std::vector<std::int64_t>{1041, 2041});
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("An AEDAT 3.1 packet whose events are all invalid has no end, and loses nothing") {
  Aedat3Head head;
  head.events = head.capacity = 2;
  const std::string invalid = aedat3_event(5, 1, 1, true, false);
  const FormatReading content = read_aedat3_bytes(aedat3_davis_header() + aedat3_head(head) + invalid +
                                                  invalid + aedat3_packet(some_aedat3_events(10, 1)));
  CHECK(content.all.events == some_aedat3_events(10, 1));
  CHECK(content.all.packet_ends_us == std::vector<std::int64_t>{11});
  CHECK_FALSE(content.losses.any());
}

TEST_CASE("An AEDAT 3.1 recording crosses the overflow of its 31-bit times") {
  const std::int64_t overflow_us = std::int64_t{1} << 31;
  const std::vector<Event> events{{overflow_us - 2, 1, 2, true},
                                  {overflow_us - 1, 3, 4, false},
                                  {overflow_us, 5, 6, true},
                                  {3 * overflow_us + 7, 7, 8, false}};
  const FormatReading content = read_aedat3_bytes(aedat3_recording(events));
  CHECK(content.all.events == events);
  CHECK(content.all.packet_ends_us ==
        std::vector<std::int64_t>{overflow_us, overflow_us + 1, 3 * overflow_us + 8});
}

TEST_CASE("An AEDAT 3.1 pipe that trickles gives the same events") {
  const auto events = some_aedat3_events(0, 300);
  const std::string bytes = aedat3_recording(events);
  const TempFolder folder;
  const auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    for (std::size_t i = 0; i < bytes.size(); i += 3) out << bytes.substr(i, 3) << std::flush;
  });
  const FormatReading content = read_aedat3(pipe);
  writer.join();
  CHECK(content.all.events == events);
  CHECK(content.losses.text().empty());
}

TEST_CASE("An AEDAT 3.1 recording opens by its first bytes, whatever it is called") {
  const auto events = some_aedat3_events(0, 300);
  const TempFolder folder;
  const auto source = open_recording(folder.write("recording.bin", aedat3_recording(events)), {});
  CHECK(source->header().format == "aedat3");
  CHECK(source->sensor_size() == SensorSize{240, 180});
  CHECK(drain(*source).events == events);
  CHECK(source->fraction_read() == 1.0);
}

}  // namespace esi::test
