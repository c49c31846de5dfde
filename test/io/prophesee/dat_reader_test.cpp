#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/prophesee/dat_reader.hpp"
#include "support/prophesee_file.hpp"
#include "support/random_events.hpp"
#include "support/read_format.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kHeader = prophesee_lines({"Data file containing CD events.", "Version 2"});

FormatReading read_dat(const std::string& bytes) { return read_bytes_with(open_prophesee_dat, bytes); }

std::string dat_error(const std::string& bytes) {
  try {
    read_dat(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("DAT records of both event types give their events") {
  const std::string type = GENERATE(std::string("\x0c\x08"), std::string("\x00\x08", 2));
  // x 0x1234, y 0x2345, on; then x 16383, y 16383, off, with the bits above polarity set.
  const std::string records("\x01\x02\x03\x04\x34\x52\xd1\x18\x02\x02\x03\x04\xff\xff\xff\xef", 16);
  const FormatReading reading = read_dat(kHeader + type + records);
  const std::vector<Event> expected = {{0x04030201, 0x1234, 0x2345, true}, {0x04030202, 16383, 16383, false}};
  CHECK(reading.all.events == expected);
  CHECK_FALSE(reading.header.sensor);
  CHECK(reading.header.format == "prophesee-dat");
  CHECK(reading.notes().empty());
  CHECK(reading.losses.text().empty());
}

TEST_CASE("DAT times that wrap go on, times that go back a little go back") {
  const FormatReading reading =
      read_dat(kHeader + "\x0c\x08" +
               words64({dat_record(0xFFFF'FFFF, 1, 2, true), dat_record(1, 1, 2, true),
                        dat_record(0xFFFF'0000, 1, 2, true), dat_record(0xFFFE'0000, 1, 2, true)}));
  std::vector<std::int64_t> times;
  for (const Event& event : reading.all.events) times.push_back(event.t_us);
  CHECK(times == std::vector<std::int64_t>{0xFFFF'FFFF, 0x1'0000'0001, 0x1'FFFF'0000, 0x1'FFFE'0000});
}

TEST_CASE("a DAT file gives back its events, and its size where it has one") {
  const auto events = random_events({0, 0, 240, 180}, 30000, 40, 3);
  const FormatReading reading = read_dat(dat_recording(events));
  CHECK(reading.all.events == events);
  CHECK(reading.header.sensor == SensorSize{240, 180});
  CHECK(reading.most_events_at_once < 2 * kPacketEvents);
  const std::string line = GENERATE("Width 240", "Height 180", "Width x", "Width 0");
  CHECK_FALSE(read_dat(kHeader + prophesee_lines({line, "Height 70000"}) + "\x0c\x08").header.sensor);
}

TEST_CASE("DAT files of other types are refused in words") {
  const auto [type, message] = GENERATE(table<std::string, const char*>({
      {"\x0e\x08", "external triggers (event type 14"},
      {"\x0d\x08", "event type 13 at byte"},
      {"%\x08", "event type 37 at byte"},
      {"\x0c\x10", "an event has 16 bytes"},
      {"\x0c", "ends within its header"},
      {"", "ends within its header"},
  }));
  CHECK_THAT(dat_error(kHeader + type + (type.size() < 2 ? "" : "12345678")),
             Contains(message) && Contains("recording:"));
}

}  // namespace esi::test
