#include "esi/io/aedat2/reader.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "io/aedat2/read_aedat2.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kDvs128 = aedat2_header("ch.unizh.ini.jaer.chip.retina.DVS128");
const std::string kDavis240 = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");

}  // namespace

TEST_CASE("AEDAT 2 of a DVS128 gives its events with the origin at the top left") {
  // Written out by hand: bit 15 external, 14..8 y from the bottom, 7..1 x from the right, bit 0 is 1 for OFF.
  const std::string records = aedat2_record(0x0000, 1000) + aedat2_record(0x0001, 1001) +
                              aedat2_record(0x7FFE, 1002) + aedat2_record(0x8000, 1003) +
                              aedat2_record(0x0307, 1004);
  const FormatReading content = read_aedat2_bytes(kDvs128 + records);
  CHECK(content.all.events ==
        std::vector<Event>{
            {1000, 127, 127, true}, {1001, 127, 127, false}, {1002, 0, 0, true}, {1004, 124, 124, false}});
  CHECK(content.header.sensor == SensorSize{128, 128});
  CHECK(content.header.format == "aedat2");
  CHECK(content.header.layout == "AEDAT 2.0, DVS128");
  CHECK_FALSE(content.header.has_packets);
  CHECK_FALSE(content.header.has_intensity_frames);
  CHECK(content.all.packet_ends_us.empty());
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("AEDAT 2 of a DAVIS gives its events and passes over external signals and the IMU") {
  // Bits 30..22 y from the bottom, 21..12 x from the right, bit 11 ON, bit 10 external.
  const std::string records = aedat2_record(0x00000000, 10) + aedat2_record(0x00000800, 11) +
                              davis_imu_sample(12) + aedat2_record(179U << 22 | 239U << 12 | 0x800, 13) +
                              aedat2_record(0x00000402, 14) + aedat2_record(0x00000C03, 15) +
                              aedat2_record(2U << 22 | 5U << 12, 16);
  const FormatReading content = read_aedat2_bytes(kDavis240 + records);
  CHECK(content.all.events ==
        std::vector<Event>{
            {10, 239, 179, false}, {11, 239, 179, true}, {13, 0, 0, true}, {16, 234, 177, false}});
  CHECK(content.header.sensor == SensorSize{240, 180});
  CHECK(content.header.has_intensity_frames);
  CHECK(content.all.frames.empty());
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("The events of an AEDAT 2 file come in bounded pieces") {
  std::vector<Event> events;
  for (int i = 0; i < 50'000; ++i) {
    events.push_back(
        {i * 7, static_cast<std::uint16_t>(i % 240), static_cast<std::uint16_t>(i % 179), i % 3 == 0});
  }
  const FormatReading content = read_aedat2_bytes(aedat2_recording(events));
  CHECK(content.all.events == events);
  CHECK(content.most_events_at_once == kPacketEvents);
}

TEST_CASE("Events beyond the sensor of an AEDAT 2 file are counted") {
  const auto [header, address] = GENERATE(table<std::string, std::uint32_t>({
      {kDavis240, davis_address(240, 0, true)},
      {kDavis240, davis_address(0, 180, true)},
      {kDavis240, davis_address(1023, 511, false)},
      {kDvs128, 0x10000},
      {kDvs128, 0x80008000},
  }));
  const FormatReading content = read_aedat2_bytes(header + aedat2_record(address, 1) + aedat2_record(0, 2));
  CHECK(content.all.events.size() == 1);
  CHECK(content.losses.text() == "1 outside_sensor");
}

TEST_CASE("The clock of an AEDAT 2 file is unwrapped, a small step back is none") {
  struct Row {
    std::vector<std::uint32_t> stored;
    std::vector<std::int64_t> expected;
    bool is_wrap_told;
  };
  const auto row =
      GENERATE(Row{{5, 3, 4}, {5, 3, 4}, false},
               Row{{0x80000005, 0x90000000, 0xFFFFFFFF}, {0x80000005, 0x90000000, 0xFFFFFFFF}, false},
               Row{{0xFFFFFFFE, 1, 5}, {0xFFFFFFFE, 0x100000001, 0x100000005}, true},
               Row{{0xFFFFFFFE, 1, 0xFFFFFFFF, 2}, {0xFFFFFFFE, 0x100000001, 0xFFFFFFFF, 0x100000002}, true},
               Row{{3, 0xFFFFFFFF, 4}, {3, -1, 4}, false},
               Row{{0, 0x7FFFFFFF, 0xF0000000, 0x20000000, 0xF0000000},
                   {0, 0x7FFFFFFF, 0xF0000000, 0x120000000, 0xF0000000},
                   true},
               Row{{0xC0000000, 0, 0x40000000, 0x80000000, 0xC0000000, 0x30000000},
                   {0xC0000000, 0x100000000, 0x140000000, 0x180000000, 0x1C0000000, 0x230000000},
                   true});
  std::string records;
  for (const std::uint32_t t_us : row.stored) records += aedat2_record(0, t_us);
  const FormatReading content = read_aedat2_bytes(kDvs128 + records);
  std::vector<std::int64_t> times_us;
  for (const Event& event : content.all.events) times_us.push_back(event.t_us);
  CHECK(times_us == row.expected);
  CHECK(content.header.notes.size() == (row.is_wrap_told ? 1 : 0));
  if (row.is_wrap_told) CHECK_THAT(content.notes(), Contains("32-bit clock wraps"));
}

TEST_CASE("An AEDAT 2 pipe that trickles gives the same events") {
  std::vector<Event> events;
  for (std::uint16_t i = 0; i < 100; ++i) events.push_back({i, i, i, true});
  const std::string bytes = aedat2_recording(events);
  const TempFolder folder;
  const auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    for (std::size_t i = 0; i < bytes.size(); i += 3) out << bytes.substr(i, 3) << std::flush;
  });
  const FormatReading content = read_aedat2(pipe);
  writer.join();
  CHECK(content.all.events == events);
  CHECK(content.losses.text().empty());
}

TEST_CASE("The reader of AEDAT 2 says how far it is") {
  const TempFolder folder;
  const auto path = folder.write("recording", aedat2_recording(std::vector<Event>(3, {1, 2, 3, true})));
  const auto reader = open_aedat2(std::make_unique<ByteSource>(path), {});
  CHECK(reader->fraction_read() < 1.0);
  Packet packet;
  Losses losses;
  REQUIRE(reader->read(packet, losses));
  CHECK(reader->fraction_read() == 1.0);
}

}  // namespace esi::test
