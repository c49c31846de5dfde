#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <thread>

#include "esi/core/error.hpp"
#include "io/aedat4/read_aedat4.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

std::string message_of(const std::string& bytes, const ReadOptions& options = {}) {
  try {
    read_aedat4_bytes(bytes, options);
  } catch (const Error& error) {
    return (error.kind() == Error::Kind::usage ? "usage: " : "failure: ") + std::string(error.what());
  }
  return "no error";
}

ReadOptions with_stream(const std::string& stream) {
  ReadOptions options;
  options.stream = stream;
  return options;
}

}  // namespace

TEST_CASE("AEDAT 4 of every compression gives the events that were stored") {
  const auto [compression, layout] =
      GENERATE(table<Aedat4Compression, const char*>({{Aedat4Compression::none, "AEDAT 4, NONE"},
                                                      {Aedat4Compression::lz4, "AEDAT 4, LZ4"},
                                                      {Aedat4Compression::lz4_high, "AEDAT 4, LZ4_HIGH"},
                                                      {Aedat4Compression::zstd, "AEDAT 4, ZSTD"},
                                                      {Aedat4Compression::zstd_high, "AEDAT 4, ZSTD_HIGH"}}));
  INFO(layout);
  // One packet is small, one fills several read() calls and more than the first 256 KiB of its buffer.
  const auto small = some_aedat4_events(kStart_us, 100);
  const auto large = some_aedat4_events(kStart_us + 10'000, 40'000);
  Aedat4File file = aedat4_event_file(compression);
  file.add(0, aedat4_event_buffer(small));
  file.add(0, aedat4_event_buffer(large));
  file.add(0, aedat4_event_buffer(some_aedat4_events(kStart_us + 500'000, 1)));

  const FormatReading content = read_aedat4_bytes(file.bytes());
  auto expected = as_read(small);
  const auto rest = as_read(large);
  expected.insert(expected.end(), rest.begin(), rest.end());
  expected.push_back({kStart_us + 500'000, 0, 0, true});
  CHECK(content.all.events == expected);
  CHECK(content.all.packet_ends_us ==
        std::vector<std::int64_t>{kStart_us + 991, kStart_us + 409'991, kStart_us + 500'001});
  CHECK(content.most_events_at_once <= kPacketEvents);
  CHECK(content.header.layout == layout);
  CHECK(content.header.format == "aedat4");
  CHECK(content.header.sensor == SensorSize{346, 260});
  CHECK(content.header.has_packets);
  CHECK_FALSE(content.header.has_intensity_frames);
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
}

TEST_CASE("A packet of the file ends in the read() that gives its last event") {
  Aedat4File file = aedat4_event_file(Aedat4Compression::lz4);
  file.add(0, aedat4_event_buffer(some_aedat4_events(kStart_us, 10'000)));
  const TempFolder folder;
  const auto path = folder.write("recording.aedat4", file.bytes());
  const auto reader = open_aedat4(std::make_unique<ByteSource>(path), {});
  Packet packet;
  Losses losses;
  REQUIRE(reader->read(packet, losses));
  CHECK(packet.events.size() == kPacketEvents);
  CHECK(packet.packet_ends_us.empty());
  packet.clear();
  REQUIRE(reader->read(packet, losses));
  CHECK(packet.events.size() == 10'000 - kPacketEvents);
  CHECK(packet.packet_ends_us.size() == 1);
  CHECK(reader->fraction_read() == 1.0);
  packet.clear();
  CHECK_FALSE(reader->read(packet, losses));
}

TEST_CASE("An AEDAT 4 pipe that trickles gives the same events") {
  const auto events = some_aedat4_events(kStart_us, 300);
  Aedat4File file = aedat4_event_file(Aedat4Compression::zstd);
  for (auto first = events.begin(); first != events.end(); first += 100) {
    file.add(0, aedat4_event_buffer({first, first + 100}));
  }
  const std::string bytes = file.bytes();
  const TempFolder folder;
  const auto pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] {
    std::ofstream out(pipe, std::ios::binary);
    for (std::size_t i = 0; i < bytes.size(); i += 3) out << bytes.substr(i, 3) << std::flush;
  });
  const FormatReading content = read_aedat4(pipe);
  writer.join();
  CHECK(content.all.events == as_read(events));
  CHECK(content.losses.text().empty());
}

TEST_CASE("AEDAT 4 events with negative coordinates are left out, any polarity but 0 is ON") {
  const auto [stored, expected] = GENERATE(table<std::vector<Aedat4Event>, std::vector<Event>>({
      {{{1, -1, 5, 1}, {2, 1, 2, 1}}, {{2, 1, 2, true}}},
      {{{1, 5, -32768, 1}, {2, 1, 2, 0}}, {{2, 1, 2, false}}},
      {{{1, 32767, 32766, 2}, {2, 1, 2, 0}}, {{1, 32767, 32766, true}, {2, 1, 2, false}}},
      {{{1, 0, 0, 0}, {2, 1, 2, 255}}, {{1, 0, 0, false}, {2, 1, 2, true}}},
      {{{1, 3, 3, 128}, {1, -5, -5, 1}, {2, 0, 0, 0}}, {{1, 3, 3, true}, {2, 0, 0, false}}},
      {{{2, -1, -1, 1}}, {}},
  }));
  Aedat4File file = aedat4_event_file(Aedat4Compression::lz4);
  file.add(0, aedat4_event_buffer(stored));
  file.add(0, aedat4_event_buffer({}));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.events == expected);
  CHECK(content.all.packet_ends_us == std::vector<std::int64_t>{3});
  CHECK(content.losses.dropped() == static_cast<std::int64_t>(stored.size() - expected.size()));
  CHECK(content.losses.of(Drop::outside_sensor) == content.losses.dropped());
}

TEST_CASE("AEDAT 4 events whose vector is aligned to 4 bytes only are read") {
  const auto events = some_aedat4_events(kStart_us, 10);
  Aedat4File file = aedat4_event_file(Aedat4Compression::none);
  file.add(0, aedat4_event_buffer(events, 4));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.events == as_read(events));
  CHECK(content.losses.text().empty());
}

TEST_CASE("Other streams of an AEDAT 4 file don't stop its events") {
  const auto events = some_aedat4_events(kStart_us, 20);
  Aedat4File file(Aedat4Compression::lz4,
                  aedat4_xml(aedat4_stream_xml(7, "IMUS", "") + aedat4_stream_xml(2, "EVTS", "346x260") +
                             aedat4_stream_xml(3, "TRIG", "") + aedat4_stream_xml(4, "", "")));
  for (const std::int32_t other : {7, 3, 4}) file.add_stored(other, "neither decoded nor needed");
  file.add(2, aedat4_event_buffer(events));
  file.add_stored(7, "");
  file.add_stored(2, "");
  file.add(2, aedat4_event_buffer(events));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.events.size() == 40);
  CHECK(content.losses.text().empty());
}

TEST_CASE("Of several event streams in an AEDAT 4 file one must be chosen") {
  Aedat4File file(Aedat4Compression::lz4, aedat4_xml(aedat4_stream_xml(0, "EVTS", "346x260", "left") +
                                                     aedat4_stream_xml(1, "IMUS", "") +
                                                     aedat4_stream_xml(5, "EVTS", "640x480", "right")));
  file.add(0, aedat4_event_buffer({{1, 1, 1, 1}}));
  file.add(5, aedat4_event_buffer({{2, 600, 2, 0}}));
  const std::string bytes = file.bytes();

  const FormatReading right = read_aedat4_bytes(bytes, with_stream("5"));
  CHECK(right.all.events == std::vector<Event>{{2, 600, 2, false}});
  CHECK(right.header.sensor == SensorSize{640, 480});
  CHECK(read_aedat4_bytes(bytes, with_stream("0")).all.events == std::vector<Event>{{1, 1, 1, true}});

  CHECK_THAT(message_of(bytes),
             Contains("usage: ") && Contains("--stream") &&
                 Contains("0: EVTS 346x260 left, 1: IMUS DAVIS346_1, 5: EVTS 640x480 right"));
  const std::string wrong = GENERATE("1", "2", "5x", "right", " 5");
  CHECK_THAT(message_of(bytes, with_stream(wrong)), Contains("usage: ") && Contains("'" + wrong + "'"));
}

TEST_CASE("An AEDAT 4 file without event stream says which streams it has") {
  const Aedat4File file(Aedat4Compression::lz4, aedat4_xml(aedat4_stream_xml(1, "FRME", "346x260") +
                                                           aedat4_stream_xml(2, "IMUS", "")));
  CHECK_THAT(message_of(file.bytes()), Contains("failure: ") && Contains("no event stream") &&
                                           Contains("1: FRME 346x260 DAVIS346_1, 2: IMUS DAVIS346_1"));
}

}  // namespace esi::test
