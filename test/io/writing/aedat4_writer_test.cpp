#include <lz4frame.h>

#include <cstring>

#include "io/writing/writer_fixtures.hpp"

using Catch::Contains;
using esi::Event;
using esi::test::TempFolder;

namespace {

template <class Number>
Number number_at(std::string_view bytes, std::size_t position) {
  REQUIRE(position + sizeof(Number) <= bytes.size());
  Number number;
  std::memcpy(&number, bytes.data() + position, sizeof number);
  return number;
}

/// A table of a FlatBuffer, read by hand as formats.md section 1.4 says.
struct Table {
  std::string_view bytes;
  std::size_t position = 0;

  static Table root(std::string_view size_prefixed, std::string_view identifier) {
    REQUIRE(number_at<std::uint32_t>(size_prefixed, 0) == size_prefixed.size() - 4);
    REQUIRE(size_prefixed.substr(8, 4) == identifier);
    return {size_prefixed, 4 + number_at<std::uint32_t>(size_prefixed, 4)};
  }

  /// Where a field is, or 0.
  std::size_t field(std::size_t slot) const {
    const auto vtable = static_cast<std::size_t>(static_cast<std::int64_t>(position) -
                                                 number_at<std::int32_t>(bytes, position));
    if (4 + 2 * slot >= number_at<std::uint16_t>(bytes, vtable)) return 0;
    const std::size_t offset = number_at<std::uint16_t>(bytes, vtable + 4 + 2 * slot);
    return offset == 0 ? 0 : position + offset;
  }
  template <class Number>
  Number number(std::size_t slot) const {
    return field(slot) == 0 ? Number{0} : number_at<Number>(bytes, field(slot));
  }
  std::size_t follow(std::size_t at) const { return at + number_at<std::uint32_t>(bytes, at); }
  std::size_t vector(std::size_t slot) const { return follow(field(slot)); }
};

std::string decompressed(std::string_view frame) {
  LZ4F_dctx* context = nullptr;
  LZ4F_createDecompressionContext(&context, LZ4F_VERSION);
  std::string text(std::size_t{1} << 24, '\0');
  std::size_t text_bytes = text.size(), frame_bytes = frame.size();
  const std::size_t rest =
      LZ4F_decompress(context, text.data(), &text_bytes, frame.data(), &frame_bytes, nullptr);
  LZ4F_freeDecompressionContext(context);
  REQUIRE((rest == 0 && frame_bytes == frame.size()));
  text.resize(text_bytes);
  return text;
}

struct File {
  std::string bytes;
  std::string xml;
  std::size_t first_packet = 0;
  std::int64_t table_position = 0;

  explicit File(const std::filesystem::path& path) : bytes(esi::test::content_of(path)) {
    REQUIRE(bytes.substr(0, 14) == "#!AER-DAT4.0\r\n");
    const std::size_t size = number_at<std::uint32_t>(bytes, 14);
    first_packet = 18 + size;
    const Table header = Table::root(std::string_view(bytes).substr(14, 4 + size), "IOHE");
    CHECK(header.number<std::int32_t>(0) == 1);  // LZ4
    table_position = header.number<std::int64_t>(1);
    const std::size_t text = header.vector(2);
    xml = header.bytes.substr(text + 4, number_at<std::uint32_t>(header.bytes, text));
  }
};

struct Row {
  std::int64_t byte_offset = 0;
  std::int32_t stream = 0, size = 0;
  std::int64_t elements = 0, begin_us = 0, end_us = 0;
  friend bool operator==(const Row&, const Row&) = default;
};

/// What the file's table says.
std::vector<Row> table_of(const File& file) {
  const std::string buffer =
      decompressed(std::string_view(file.bytes).substr(static_cast<std::size_t>(file.table_position)));
  const Table root = Table::root(buffer, "FTAB");
  const std::size_t vector = root.vector(0);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < number_at<std::uint32_t>(buffer, vector); ++i) {
    const Table row{buffer, root.follow(vector + 4 + 4 * i)};
    const std::size_t info = row.field(1);
    rows.push_back({row.number<std::int64_t>(0), number_at<std::int32_t>(buffer, info),
                    number_at<std::int32_t>(buffer, info + 4), row.number<std::int64_t>(2),
                    row.number<std::int64_t>(3), row.number<std::int64_t>(4)});
  }
  return rows;
}

/// What a packet holds: elements and their times.
void describe_content(const std::string& buffer, Row& row) {
  if (row.stream == 1) {
    const Table frame = Table::root(buffer, "FRME");
    row.elements = 1;
    row.begin_us = frame.number<std::int64_t>(3);
    row.end_us = frame.number<std::int64_t>(4);
    return;
  }
  const std::size_t vector = Table::root(buffer, "EVTS").vector(0);
  const std::size_t events = number_at<std::uint32_t>(buffer, vector);
  CHECK((vector + 4) % 8 == 0);
  row.elements = static_cast<std::int64_t>(events);
  row.begin_us = number_at<std::int64_t>(buffer, vector + 4);
  row.end_us = number_at<std::int64_t>(buffer, vector + 4 + 16 * (events - 1));
}

/// What a walk from packet to packet finds.
std::vector<Row> packets_of(const File& file) {
  std::vector<Row> rows;
  std::size_t position = file.first_packet;
  while (position < static_cast<std::size_t>(file.table_position)) {
    Row row;
    row.byte_offset = static_cast<std::int64_t>(position + 8);
    row.stream = number_at<std::int32_t>(file.bytes, position);
    row.size = number_at<std::int32_t>(file.bytes, position + 4);
    const auto size = static_cast<std::size_t>(row.size);
    describe_content(decompressed(std::string_view(file.bytes).substr(position + 8, size)), row);
    rows.push_back(row);
    position += 8 + size;
  }
  CHECK(position == static_cast<std::size_t>(file.table_position));
  return rows;
}

}  // namespace

TEST_CASE("The table of an AEDAT 4 file says of each packet where it is and what it holds") {
  const TempFolder folder;
  const esi::test::Content content{esi::test::random_events({0, 0, 346, 260}, 30000, 30, 2),
                                   esi::test::noise_frames(1000, 20)};
  esi::test::write_recording(folder / "a.aedat4", content, {{346, 260}, 1'650'000'000'000'000, "camera"});
  const File file(folder / "a.aedat4");
  const std::vector<Row> rows = table_of(file);
  CHECK((rows == packets_of(file)));
  std::int64_t events = 0, frames = 0;
  for (const Row& row : rows) {
    (row.stream == 0 ? events : frames) += row.elements;
    if (row.stream == 0) CHECK(row.end_us - row.begin_us < 10000);
  }
  CHECK(events == 30000);
  CHECK(frames == 20);
  CHECK(rows.front().begin_us == 1'650'000'000'000'000);
}

TEST_CASE("An AEDAT 4 file's packets of events have bounds in time and number, and its table may be empty") {
  const TempFolder folder;
  const auto numbers = [&](std::vector<Event> events) {
    esi::test::write_recording(folder / "a.aedat4", {std::move(events), {}});
    std::vector<std::int64_t> elements;
    for (const Row& row : table_of(File(folder / "a.aedat4"))) elements.push_back(row.elements);
    return elements;
  };
  using Numbers = std::vector<std::int64_t>;
  CHECK(numbers({}) == Numbers{});
  CHECK(numbers({{3, 1, 1, true}, {10002, 1, 1, true}, {10003, 1, 1, true}}) == Numbers{2, 1});
  CHECK(numbers({{-20000, 1, 1, true}, {-10001, 1, 1, true}, {900000, 1, 1, true}}) == Numbers{2, 1});
  CHECK(numbers(std::vector<Event>(150000, Event{7, 1, 1, true})) == Numbers{65536, 65536, 18928});
}

TEST_CASE("The XML of an AEDAT 4 file names its streams, their size and the camera, escaped") {
  const TempFolder folder;
  esi::test::write_recording(folder / "a.aedat4", {}, {{346, 260}, 77, "a<b>&\"c"});
  const File file(folder / "a.aedat4");
  for (const char* const text :
       {"<dv version=\"2.0\">", "<node name=\"outInfo\"", "<node name=\"0\"", "<node name=\"1\"",
        "<attr key=\"typeIdentifier\" type=\"string\">EVTS</attr>",
        "<attr key=\"typeIdentifier\" type=\"string\">FRME</attr>",
        "<attr key=\"sizeX\" type=\"int\">346</attr>", "<attr key=\"sizeY\" type=\"int\">260</attr>",
        "<attr key=\"compression\" type=\"string\">LZ4</attr>",
        "<attr key=\"source\" type=\"string\">a&lt;b&gt;&amp;\"c</attr>",
        "<attr key=\"tsOffset\" type=\"long\">77</attr>"}) {
    CHECK_THAT(file.xml, Contains(text));
  }
  const auto source = esi::open_recording(folder / "a.aedat4", {});
  CHECK(source->sensor_size() == esi::SensorSize{346, 260});
  CHECK(source->header().has_intensity_frames);
}

TEST_CASE("What stands on the disk of an AEDAT 4 file that is still being written can be read") {
  const TempFolder folder;
  const auto events = esi::test::random_events({0, 0, 346, 260}, 100000, 5, 2);
  const auto writer = esi::open_recording_writer(folder / "a.aedat4", esi::test::kWriteOptions);
  for (const esi::Packet& packet : esi::test::packets_of({events, {}})) writer->write(packet);
  const auto cut = folder.write("cut.aedat4", esi::test::content_of(folder / "a.aedat4.part"));
  const auto source = esi::open_recording(cut, {});
  std::vector<Event> found;
  esi::Packet packet;
  while (source->next(packet)) found.insert(found.end(), packet.events.begin(), packet.events.end());
  CHECK(found.size() > 10000);
  CHECK((std::equal(found.begin(), found.end(), events.begin())));
}

TEST_CASE("A frame of an AEDAT 4 file has its slots as the format orders them") {
  const TempFolder folder;
  const cv::Mat1b image = (cv::Mat1b(2, 3) << 1, 2, 3, 4, 5, 6);
  esi::test::write_recording(folder / "a.aedat4", {{}, {{{100, 130}, image}}}, {{3, 2}, 1000, ""});
  const File file(folder / "a.aedat4");
  const Row row = table_of(file).at(0);
  const std::string buffer = decompressed(
      std::string_view(file.bytes)
          .substr(static_cast<std::size_t>(row.byte_offset), static_cast<std::size_t>(row.size)));
  const Table frame = Table::root(buffer, "FRME");
  CHECK(frame.number<std::int64_t>(0) == 1100);
  CHECK(frame.number<std::int64_t>(3) == 1100);
  CHECK(frame.number<std::int64_t>(4) == 1130);
  CHECK(frame.number<std::int8_t>(5) == 0);
  CHECK(frame.number<std::int16_t>(6) == 3);
  CHECK(frame.number<std::int16_t>(7) == 2);
  CHECK(frame.number<std::int64_t>(11) == 30);
  CHECK(buffer.substr(frame.vector(10) + 4, 6) == "\1\2\3\4\5\6");
}
