#include <catch2/catch.hpp>

#include "io/rosbag/read_rosbag.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kConnection = rosbag_connection(0, kEvents, kDvsType);
const std::vector<Event> kFirst = some_events(1000, 50);
const std::vector<Event> kLast = some_events(5000, 70);

std::string message(const std::vector<Event>& events) {
  return rosbag_message(0, dvs_event_array(std::span(events)));
}

std::string records_around(const std::string& records) {
  return rosbag_chunk("none", kConnection + message(kFirst)) + records + rosbag_chunk("none", message(kLast));
}

/// Damaged records between two good chunks of 50 and 70 events.
FormatReading read_around(const std::string& records) {
  return read_rosbag(rosbag_file(records_around(records), kConnection));
}

std::string replaced(std::string text, std::size_t position, const std::string& bytes) {
  return text.replace(position, bytes.size(), bytes);
}

std::string flipped(std::string bytes, std::size_t position) {
  bytes[position] = static_cast<char>(bytes[position] ^ 0x55);
  return bytes;
}

}  // namespace

TEST_CASE("chunks of both kinds and records without a chunk are read") {
  const std::string records = rosbag_chunk("lz4", message(some_events(2000, 20))) +
                              message(some_events(3000, 10)) + rosbag_chunk("lz4", "") +
                              rosbag_chunk("none", "") + rosbag_record(rosbag_op(4), "index data") +
                              rosbag_record(rosbag_op(99), "from the future");
  const FormatReading reading = read_around(records);
  CHECK(reading.all.events.size() == 150);
  CHECK(reading.all.packet_ends_us == std::vector<std::int64_t>{1491, 2191, 3091, 5691});
  CHECK(reading.losses.text().empty());
  CHECK(reading.notes().empty());
}

TEST_CASE("a large chunk and a large message are read in small packets") {
  const std::string compression = GENERATE("none", "lz4");
  const std::vector<Event> events = some_events(0, 300000);  // 3.9 MB
  const FormatReading reading =
      read_rosbag(rosbag_of(kDvsType, {dvs_event_array(std::span(events))}, compression));
  CHECK(reading.all.events == events);
  CHECK(reading.most_events_at_once < 2 * kPacketEvents);
  CHECK(reading.all.packet_ends_us == std::vector<std::int64_t>{3000000 - 10 + 1});
}

TEST_CASE("a chunk compressed with bz2 is refused with advice") {
  CHECK_THAT(rosbag_error(rosbag_of(kDvsType, {"..."}, "bz2")),
             Contains("bz2") && Contains("rosbag decompress") && Contains("at byte 4109"));
}

TEST_CASE("a damaged record of a bag is left out, those around it are read") {
  const std::string good = message(some_events(3000, 60));
  const std::string lz4 = rosbag_chunk("lz4", good);
  const std::string data = dvs_event_array(std::span(kFirst));
  const auto [what, records] = GENERATE_COPY(table<const char*, std::string>({
      {"a field without a sign", rosbag_record(rosbag_op(2) + ros_array("conn"), "x")},
      {"a field beyond the header", rosbag_record(rosbag_op(2) + ros_number(1000000), "x")},
      {"a field's length cut", rosbag_record(rosbag_op(2) + "ab", "x")},
      {"no op", rosbag_record(rosbag_field("conn", "1234"), "x")},
      {"an op of two bytes", rosbag_record(rosbag_field("op", "12"), "x")},
      {"no header", rosbag_record("", "x")},
      {"a message without connection", rosbag_record(rosbag_op(2), data)},
      {"a message of an unknown connection", rosbag_message(9, data)},
      {"a message with an event too few", rosbag_message(0, data.substr(0, data.size() - 13))},
      {"a message with a byte too many", rosbag_message(0, data + "x")},
      {"an empty message", rosbag_message(0, "")},
      {"a count that overflows", rosbag_message(0, replaced(data, 30, ros_number(0xFFFF'FFFF)))},
      {"a name that overflows", rosbag_message(0, replaced(data, 12, ros_number(0xFFFF'FFFF)))},
      {"a connection without type",
       rosbag_record(rosbag_op(7) + rosbag_field("conn", "1234"), rosbag_field("topic", "/a"))},
      {"a connection without topic",
       rosbag_record(rosbag_op(7) + rosbag_field("conn", "1234"), rosbag_field("type", "a/B"))},
      {"a topic that is no name", rosbag_connection(5, "/a\nb", kDvsType)},
      {"a damaged lz4 chunk", flipped(lz4, lz4.size() - 100)},
      {"an lz4 chunk that is none", rosbag_record(rosbag_op(5) + rosbag_field("compression", "lz4"), good)},
      {"a cut lz4 chunk",
       rosbag_record(rosbag_op(5) + rosbag_field("compression", "lz4"), "\x04\x22\x4D\x18")},
      {"an unknown compression", rosbag_chunk("zip", good)},
      {"no compression", rosbag_record(rosbag_op(5), good)},
      {"a chunk in a chunk", rosbag_chunk("none", rosbag_chunk("none", good))},
      {"a chunk in an lz4 chunk", rosbag_chunk("lz4", rosbag_chunk("lz4", good))},
      {"a record beyond its chunk", rosbag_chunk("none", good.substr(0, good.size() - 1))},
      {"a record beyond its lz4 chunk", rosbag_chunk("lz4", good.substr(0, good.size() - 1))},
      {"a header beyond its chunk", rosbag_chunk("none", ros_number(0xFFFF'FFFF) + "12345678")},
      {"seven bytes in a chunk", rosbag_chunk("none", "1234567")},
      {"three bytes in an lz4 chunk", rosbag_chunk("lz4", "123")},
  }));
  CAPTURE(what);
  const FormatReading reading = read_around(records);
  CHECK(reading.all.events.size() == 120);
  CHECK(reading.losses.text() == "1 corrupt_packet");
  CHECK(reading.header.notes.size() == 1);
  // Many of them are told once.
  std::string many;
  for (int i = 0; i < 30; ++i) many += records;
  const FormatReading reading_many = read_around(many);
  CHECK(reading_many.all.events.size() == 120);
  CHECK(reading_many.losses.text() == "30 corrupt_packet");
  CHECK(reading_many.header.notes.size() == 1);
}

TEST_CASE("what stands before a damaged record in its chunk is read") {
  const std::string compression = GENERATE("none", "lz4");
  const FormatReading reading =
      read_around(rosbag_chunk(compression, message(some_events(3000, 60)) + "and no record"));
  CHECK(reading.all.events.size() == 180);
  CHECK(reading.losses.text() == "1 corrupt_packet");
}

TEST_CASE("lengths that can't be outside of a chunk end the reading") {
  const FormatReading reading = read_around(ros_number(0x7FFF'FFFF) + std::string(100, 'x'));
  CHECK(reading.all.events.size() == 50);
  CHECK(reading.losses.text() == "1 corrupt_packet");
  CHECK_THAT(reading.notes(), Contains("reading stopped there"));
}

TEST_CASE("a decompression bomb in a bag is a damaged chunk") {
  const std::string bomb = rosbag_chunk("lz4", std::string(std::size_t{300} << 20, '\0'));
  REQUIRE(bomb.size() < (std::size_t{2} << 20));
  const FormatReading reading = read_around(bomb);
  CHECK(reading.all.events.size() == 120);
  CHECK(reading.losses.text() == "1 corrupt_packet");
}

TEST_CASE("records that claim gigabytes cost none") {
  const std::string header = GENERATE(rosbag_op(5) + rosbag_field("compression", "none"),
                                      rosbag_op(5) + rosbag_field("compression", "lz4"),
                                      rosbag_op(2) + rosbag_field("conn", ros_number(0)));
  const std::string records = ros_array(header) + ros_number(0xFFFF'FFF0);
  const FormatReading reading = read_around(records);
  CHECK(reading.all.events.size() >= 50);
  CHECK(reading.losses.any());
}

TEST_CASE("a bag whose recorder was killed is read to its end, and that is said") {
  const std::string records = kConnection + message(kFirst) + message(kLast);
  const std::string lz4 = rosbag_chunk("lz4", records);
  const std::string head = ros_array(rosbag_op(5) + rosbag_field("compression", "lz4"));
  const std::size_t frame =
      rosbag_record(rosbag_op(5) + rosbag_field("compression", "lz4") + rosbag_field("size", "1234"), "")
          .size();
  const auto [what, bytes, losses] = GENERATE_COPY(table<const char*, std::string, const char*>({
      {"whole chunks", rosbag_chunk("none", records), "1 missing_table"},
      // The recorder writes a chunk's lengths when it is done with it.
      {"a chunk of length 0", rosbag_chunk("none", "") + records, "1 missing_table"},
      {"an lz4 chunk of length 0", head + ros_number(0) + lz4.substr(frame), "1 cut_packet, 1 missing_table"},
  }));
  CAPTURE(what);
  const FormatReading reading = read_rosbag(rosbag_file_without_index(bytes));
  CHECK(reading.all.events.size() == 120);
  CHECK(reading.losses.text() == losses);
  CHECK_THAT(reading.notes(), Contains("The recorder was stopped before it wrote the bag's index"));
}

TEST_CASE("a bag is read in full wherever its header says that the index is") {
  const std::string whole = rosbag_file(records_around(""), kConnection);
  const std::uint64_t index_pos = rosbag_file_without_index(records_around("")).size();
  const std::size_t field = whole.find("index_pos=") + 10;
  REQUIRE(whole.substr(field, 8) == ros_number(index_pos));
  const std::uint64_t wrong =
      GENERATE_COPY(std::uint64_t{1}, std::uint64_t{13}, std::uint64_t{4109}, index_pos - 1, index_pos + 1);
  CAPTURE(wrong, index_pos);
  const FormatReading reading = read_rosbag(replaced(whole, field, ros_number(wrong)));
  CHECK(reading.all.events.size() == 120);
  CHECK(reading.losses.text() == "1 missing_table");
  CHECK_FALSE(reading.losses.any());
  // Behind the end: the file was cut.
  const std::uint64_t behind = GENERATE(std::uint64_t{1} << 40, UINT64_MAX);
  CHECK(read_rosbag(replaced(whole, field, ros_number(behind))).losses.text() ==
        "1 cut_packet, 1 missing_table");
}

}  // namespace esi::test
