#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "io/aedat4/read_aedat4.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

constexpr std::size_t kMiB = std::size_t{1} << 20;

std::string int32(std::int32_t value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

const std::vector<Aedat4Event> kFirst = some_aedat4_events(1000, 50);
const std::vector<Aedat4Event> kLast = some_aedat4_events(5000, 70);

/// A damaged packet between two good ones of 50 and 70 events.
FormatReading read_around(Aedat4Compression compression, const std::string& payload) {
  Aedat4File file = aedat4_event_file(compression);
  file.add(0, aedat4_event_buffer(kFirst));
  file.add_stored(0, payload);
  file.add(0, aedat4_event_buffer(kLast));
  return read_aedat4_bytes(file.bytes());
}

std::string replaced(std::string text, std::size_t position, const std::string& bytes) {
  return text.replace(position, bytes.size(), bytes);
}

std::string flipped(std::string bytes, std::size_t position) {
  bytes[position] = static_cast<char>(bytes[position] ^ 0x55);
  return bytes;
}

}  // namespace

TEST_CASE("A damaged AEDAT 4 packet is left out, those around it are read") {
  const std::string good = aedat4_event_buffer(some_aedat4_events(3000, 60));
  const std::string frame = aedat4_frame_buffer({});
  const auto [what, buffer] = GENERATE_COPY(table<const char*, std::string>({
      {"another identifier", replaced(good, 8, "EVTX")},
      {"a frame among the events", frame},
      {"a table offset beyond the buffer", replaced(good, 4, int32(0x7fffff))},
      {"a negative table offset", replaced(good, 4, int32(-8))},
      {"a vtable before the buffer", replaced(good, 24, int32(0x1000))},
      {"more events than bytes", replaced(good, 36, int32(61))},
      {"events that overflow", replaced(good, 36, int32(0x10000001))},
      {"a size beyond the buffer", replaced(good, 0, int32(1000000))},
      {"a size less than the buffer", replaced(good, 0, int32(40))},
      {"a negative size", replaced(good, 0, int32(-1))},
      {"a size of nothing", replaced(good, 0, int32(0))},
      {"bytes behind the buffer", good + "1234"},
      {"three bytes", "abc"},
      {"only its size", int32(0)},
  }));
  const auto compression =
      GENERATE(Aedat4Compression::none, Aedat4Compression::lz4, Aedat4Compression::zstd_high);
  INFO(what);
  const FormatReading content = read_around(compression, aedat4_compressed(buffer, compression));
  CHECK(content.all.events.size() == 120);
  CHECK(content.losses.text() == "1 corrupt_packet");
  CHECK_THAT(content.notes(), Contains("damaged and left out"));
}

TEST_CASE("A corrupt LZ4 or zstd frame in an AEDAT 4 file is left out, those around it are read") {
  const auto compression = GENERATE(Aedat4Compression::lz4, Aedat4Compression::zstd);
  const std::string buffer = aedat4_event_buffer(some_aedat4_events(3000, 60));
  const std::string frame = aedat4_compressed(buffer, compression);
  const auto other = compression == Aedat4Compression::lz4 ? Aedat4Compression::zstd : Aedat4Compression::lz4;
  const auto [what, payload] = GENERATE_COPY(table<const char*, std::string>({
      {"not compressed", buffer},
      {"of the other kind", aedat4_compressed(buffer, other)},
      {"another magic", flipped(frame, 0)},
      {"damaged flags", flipped(frame, 4)},
      {"damaged block", flipped(frame, 8)},
      {"cut", frame.substr(0, frame.size() - 6)},
      {"only the magic", frame.substr(0, 4)},
      {"one byte", frame.substr(0, 1)},
      {"noise", std::string(300, '\xee')},
  }));
  INFO(what);
  const FormatReading content = read_around(compression, payload);
  CHECK(content.all.events.size() == 120);
  CHECK(content.losses.text() == "1 corrupt_packet");
}

TEST_CASE("A decompression bomb in an AEDAT 4 file is a damaged packet") {
  const auto compression = GENERATE(Aedat4Compression::lz4, Aedat4Compression::zstd);
  const auto claim = GENERATE(0, 100, 300 << 20, 0x7fffffff, -1);
  const std::string bomb =
      aedat4_compressed(replaced(std::string(64 * kMiB, '\0'), 0, int32(claim)), compression);
  REQUIRE(bomb.size() < kMiB);
  INFO(claim);
  const FormatReading content = read_around(compression, bomb);
  CHECK(content.all.events.size() == 120);
  CHECK(content.losses.text() == "1 corrupt_packet");
}

TEST_CASE("Many damaged AEDAT 4 packets are counted, but told once") {
  Aedat4File file = aedat4_event_file(Aedat4Compression::lz4);
  for (int i = 0; i < 100; ++i) file.add_stored(0, "damaged");
  for (int i = 0; i < 100; ++i) file.add_stored(9, "of no stream");
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.losses.text() == "200 corrupt_packet");
  CHECK(content.header.notes.size() == 2);
  CHECK_THAT(content.notes(), Contains("is of stream 9, which the header does not declare"));
}

TEST_CASE("An AEDAT 4 packet whose size can't be is where reading stops") {
  struct Row {
    std::int32_t size;
    const char* losses;
    const char* note;
  };
  const auto row = GENERATE(Row{-1, "1 corrupt_packet", "claims -1 bytes"},
                            Row{INT32_MIN, "1 corrupt_packet", "claims -2147483648 bytes"},
                            Row{INT32_MAX, "1 corrupt_packet", "claims 2147483647 bytes"},
                            Row{(1 << 28) + 1, "1 corrupt_packet", "claims 268435457 bytes"},
                            Row{1 << 28, "1 cut_packet", "ends within the packet"},
                            Row{100'000, "1 cut_packet", "ends within the packet"});
  const auto stream = GENERATE(0, 1, 9);  // events, passed over, not declared
  INFO(row.size << " of stream " << stream);
  Aedat4File file(Aedat4Compression::lz4,
                  aedat4_xml(aedat4_stream_xml(0, "EVTS", "346x260") + aedat4_stream_xml(1, "IMUS", "")));
  file.add(0, aedat4_event_buffer(kFirst));
  const std::string position = "at byte " + std::to_string(file.position());
  file.add_stored(stream, "payload", row.size);
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.events.size() == 50);
  CHECK_THAT(content.losses.text(), Contains(row.losses));
  CHECK_THAT(content.notes(), Contains(row.note) && Contains(position));
}

TEST_CASE("AEDAT 4 is read in full wherever the header says that its table is") {
  const auto compression = GENERATE(Aedat4Compression::none, Aedat4Compression::lz4, Aedat4Compression::zstd);
  Aedat4File file = aedat4_event_file(compression);
  file.add(0, aedat4_event_buffer(kFirst));
  const auto second = static_cast<std::int64_t>(file.position());
  file.add(0, aedat4_event_buffer(kLast));
  const auto [table_position, note] = GENERATE_COPY(
      table<std::int64_t, std::string>({{-1, "The recorder was stopped"},
                                        {-2, "is not at byte -2"},
                                        {0, "is not at byte 0"},
                                        {INT64_MIN, "is not at byte -9223372036854775808"},
                                        {second, "is not at byte " + std::to_string(second)},
                                        {second + 5, "is not at byte " + std::to_string(second + 5)},
                                        {1'000'000'000'000, "is not at byte 1000000000000"},
                                        {INT64_MAX, "is not at byte 9223372036854775807"}}));
  const FormatReading content = read_aedat4_bytes(file.bytes(table_position));
  CHECK(content.all.events.size() == 120);
  CHECK(content.losses.text() == "1 missing_table");
  CHECK_FALSE(content.losses.any());
  CHECK_THAT(content.notes(), Contains(note));
  CHECK(content.header.notes.size() == 1);
}

TEST_CASE("An AEDAT 4 file without table is whole when the recorder never wrote one, else cut") {
  Aedat4File file = aedat4_event_file(Aedat4Compression::lz4);
  file.add(0, aedat4_event_buffer(kFirst));
  const auto end = static_cast<std::int64_t>(file.position());
  const auto [table_position, losses] = GENERATE_COPY(table<std::int64_t, const char*>(
      {{-1, "1 missing_table"}, {end, ""}, {end + 1, "1 cut_packet"}, {INT64_MAX, "1 cut_packet"}}));
  INFO(table_position);
  const FormatReading content = read_aedat4_bytes(file.bytes_without_table(table_position));
  CHECK(content.all.events.size() == 50);
  CHECK(content.losses.text() == losses);
}

TEST_CASE("A damaged table of an AEDAT 4 file loses nothing") {
  const std::string rubbish =
      GENERATE("rubbish!", "\xff\xff\xff\xff", "?", "rubbish that is longer than a head");
  Aedat4File file = aedat4_event_file(Aedat4Compression::lz4);
  file.add(0, aedat4_event_buffer(kFirst));
  const auto end = static_cast<std::int64_t>(file.position());
  const FormatReading content = read_aedat4_bytes(file.bytes_without_table(end) + rubbish);
  CHECK(content.all.events.size() == 50);
  CHECK(content.losses.text().empty());
}

}  // namespace esi::test
