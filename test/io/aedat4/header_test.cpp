#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "io/aedat4/read_aedat4.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

const std::string kEvents = aedat4_stream_xml(0, "EVTS", "346x260");

/// One event behind this XML.
std::string file_with(const std::string& xml) {
  Aedat4File file(Aedat4Compression::lz4, xml);
  file.add(0, aedat4_event_buffer({{1, 1, 1, 1}}));
  return file.bytes();
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("AEDAT 4 is recognised by its first 14 bytes") {
  const auto looks = [](const std::string& text) {
    return looks_like_aedat4(std::as_bytes(std::span(text)));
  };
  CHECK(looks("#!AER-DAT4.0\r\n"));
  CHECK(looks(file_with(aedat4_xml(kEvents))));
  CHECK_FALSE(looks("#!AER-DAT4.0\r"));
  CHECK_FALSE(looks("#!AER-DAT3.1\r\n"));
  CHECK_FALSE(looks(""));
}

TEST_CASE("A bad AEDAT 4 header is an error that says what and where") {
  const std::string xml = aedat4_xml(kEvents);
  const std::string magic = "#!AER-DAT4.0\r\n";
  std::string without_identifier = aedat4_header(1, -1, xml);
  without_identifier[22] = 'X';
  std::string wild_offset = aedat4_header(1, -1, xml);
  wild_offset[20] = '\x7f';
  const auto [bytes, message] = GENERATE_COPY(table<std::string, const char*>({
      {magic, "ends within its header, at byte 14"},
      {magic + "abc", "ends within its header, at byte 17"},
      {magic + std::string("\xff\xff\xff\xff", 4), "claims 4294967299 bytes"},
      {magic + std::string("\0\0\0\0", 4), "header at byte 14 is damaged"},
      {magic + std::string("\0\0\x10\0too short", 13), "ends within its header, at byte 27"},
      {without_identifier, "header at byte 14 is damaged"},
      {wild_offset, "header at byte 14 is damaged"},
      {aedat4_header(5, -1, xml), "compression 5"},
      {aedat4_header(-1, -1, xml), "compression -1"},
      {aedat4_header(1, -1, "<dv>\n<node name=\"outInfo\">\n</dv>"), "XML, line 3"},
      {aedat4_header(1, -1, ""), "XML, line 1"},
      {aedat4_header(1, -1, "<dv/>"), "lists 0 streams"},
      {aedat4_header(1, -1, "<dv>" + kEvents + "</dv>"), "lists 0 streams"},
      {aedat4_header(1, -1, aedat4_xml("<node name=\"events\"/>")), "lists 0 streams"},
      {aedat4_header(1, -1, aedat4_xml(repeated(kEvents, 300))), "lists 300 streams"},
      {aedat4_header(1, -1, repeated("<a>", 300'000)), "XML, line 1"},
  }));
  INFO(message);
  const TempFolder folder;
  const auto path = folder.write("recording.aedat4", bytes);
  CHECK_THROWS_WITH(read_aedat4(path), Contains(path.string() + ": ") && Contains(message));
}

TEST_CASE("A hostile but well-formed AEDAT 4 XML is harmless") {
  std::string bomb = "<!DOCTYPE dv [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c <= 'z'; ++c) {
    const std::string inner = std::string("&") + static_cast<char>(c - 1) + ";";
    bomb += std::string("<!ENTITY ") + c + " \"" + repeated(inner, 10) + "\">";
  }
  bomb += "]>";
  const auto xml = GENERATE_COPY(values<std::string>({
      bomb + aedat4_xml("&z;" + kEvents + "<attr key=\"x\">&z;</attr>"),
      aedat4_xml(kEvents + repeated("<node name=\"1\">", 200'000) + repeated("</node>", 200'000)),
      "<!DOCTYPE dv SYSTEM \"file:///etc/passwd\">" + aedat4_xml(kEvents),
  }));
  CHECK(read_aedat4_bytes(file_with(xml)).all.events.size() == 1);
}

TEST_CASE("An AEDAT 4 file without a possible sensor size is read, and that is said") {
  const std::string size =
      GENERATE("", "0x260", "346x-1", "346x99999999999999", "32769x1", "346.0x260", "ax");
  INFO(size);
  const FormatReading content = read_aedat4_bytes(file_with(aedat4_xml(aedat4_stream_xml(0, "EVTS", size))));
  CHECK(content.all.events.size() == 1);
  CHECK_FALSE(content.header.sensor);
  CHECK_THAT(content.notes(), Contains("no possible sensor size"));
}

TEST_CASE("Names in an AEDAT 4 header can't break a message into lines") {
  const auto xml = aedat4_xml(aedat4_stream_xml(1, "IM\nUS", "", std::string(1000, 'x')));
  try {
    read_aedat4_bytes(file_with(xml));
    FAIL("no error");
  } catch (const Error& error) {
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.size() < 300);
  }
}

}  // namespace esi::test
