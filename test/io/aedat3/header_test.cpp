#include <catch2/catch.hpp>

#include "io/aedat3/read_aedat3.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

bool is_recognised(const std::string& head) { return looks_like_aedat3(std::as_bytes(std::span(head))); }

ReadOptions with_stream(const std::string& stream) {
  ReadOptions options;
  options.stream = stream;
  return options;
}

}  // namespace

TEST_CASE("AEDAT 3 is recognised by its first line") {
  CHECK(is_recognised("#!AER-DAT3.1\r\n"));
  CHECK(is_recognised("#!AER-DAT3.0\r\n"));
  const std::string other = GENERATE("", "#!AER-DAT3", "#!AER-DAT2.0\r\n", "#!AER-DAT4.0\r\n", "#!AER-DAT31");
  CHECK_FALSE(is_recognised(other));
}

TEST_CASE("The source of an AEDAT 3.1 file gives the sensor and whether it has frames") {
  const auto [source, sensor, has_frames] = GENERATE(table<const char*, SensorSize, bool>({
      {"DVS128", {128, 128}, false},
      {"DAVIS240C", {240, 180}, true},
      {"DAVIS346Cbsi", {346, 260}, true},
      {"DAVIS346bsi", {346, 260}, true},
      {"DAVIS640", {640, 480}, true},
      {"DAVIS208", {208, 192}, true},
      {"DAVIS128", {128, 128}, true},
      {"File,dvsSizeX=320,dvsSizeY=200,apsSizeX=640,apsSizeY=480,dataSizeX=1", {320, 200}, true},
      {"Network,dvsSizeX=32768,dvsSizeY=1,apsSizeX=0,apsSizeY=0", {32768, 1}, false},
  }));
  INFO(source);
  const std::string header =
      aedat3_header(std::string("#Source 7: ") + source + "\r\n#-Source 3: DVS128\r\n#a comment\r\n");
  const FormatReading content = read_aedat3_bytes(header + aedat3_packet(some_aedat3_events(1, 2), 7));
  CHECK(content.all.events.size() == 2);
  CHECK(content.header.sensor == sensor);
  CHECK(content.header.has_intensity_frames == has_frames);
  CHECK(content.notes().empty());
}

TEST_CASE("An AEDAT 3.1 file of an unknown source is read, without a sensor size or with the given chip's") {
  const std::string source = GENERATE("#Source 1: FUTURE9000\r\n", "#Source 1: DAVISHet640\r\n",
                                      "#Source 1: File,dvsSizeX=0,dvsSizeY=5\r\n",
                                      "#Source 1: File,dvsSizeX=32769,dvsSizeY=5\r\n", "#Source 1\r\n", "");
  const std::string bytes = aedat3_header(source) + aedat3_packet(some_aedat3_events(1, 2));
  const FormatReading content = read_aedat3_bytes(bytes);
  CHECK(content.all.events == some_aedat3_events(1, 2));
  CHECK_FALSE(content.header.sensor);
  CHECK_THAT(content.notes(), Contains("--chip") && Contains("--size"));
  ReadOptions options;
  options.chip = "davis346";
  const FormatReading given = read_aedat3_bytes(bytes, options);
  CHECK(given.header.sensor == SensorSize{346, 260});
  CHECK(given.notes().empty());
}

TEST_CASE("Of several sources in an AEDAT 3.1 file one is chosen with --stream") {
  const std::string bytes =
      aedat3_header("#Source 1: DAVIS240C\r\n#Source 2: DVS128\r\n#Source 9: Mixer\r\n") +
      aedat3_packet(some_aedat3_events(1, 2), 1) + aedat3_packet(some_aedat3_events(5, 3), 2);
  const FormatReading first = read_aedat3_bytes(bytes, with_stream("1"));
  CHECK(first.all.events == some_aedat3_events(1, 2));
  CHECK(first.header.sensor == SensorSize{240, 180});
  const FormatReading second = read_aedat3_bytes(bytes, with_stream("2"));
  CHECK(second.all.events == some_aedat3_events(5, 3));
  CHECK(second.header.sensor == SensorSize{128, 128});
  CHECK_THAT(aedat3_refusal(bytes), Contains("usage: ") && Contains("--stream") &&
                                        Contains("1: DAVIS240C 240x180, 2: DVS128 128x128, 9: Mixer"));
  const std::string wrong = GENERATE("3", "left", "1x", " 1", "01");
  CHECK_THAT(aedat3_refusal(bytes, with_stream(wrong)),
             Contains("usage: ") && Contains("'" + wrong + "'") && Contains("1: DAVIS240C"));
}

TEST_CASE("Of an AEDAT 3.1 file's sources only cameras count") {
  const std::string bytes = aedat3_header("#Source 2: DYNAPSE\r\n#Source 1: DVS128\r\n#Source 3: Mixer\r\n") +
                            aedat3_packet(some_aedat3_events(1, 2), 1);
  CHECK(read_aedat3_bytes(bytes).all.events.size() == 2);
  CHECK_THAT(aedat3_refusal(aedat3_header("#Source 2: A\r\n#Source 1: B\r\n") + "1234"),
             Contains("usage: ") && Contains("2: A, 1: B"));
}

TEST_CASE("An AEDAT 3 file with another version, format or no end of its header is refused") {
  const std::string packet = aedat3_packet(some_aedat3_events(1, 2));
  const auto [bytes, what] = GENERATE_COPY(table<std::string, std::string>({
      {aedat3_header("", "RAW", "3.0") + packet, "AEDAT 3.0"},
      {"#!AER-DAT3.0\r\n#Format: RAW\r\n#Source 1: DVS128\r\n" + packet, "AEDAT 3.0"},
      {aedat3_header("", "RAW", "3.2") + packet, "AEDAT 3.2"},
      {aedat3_header("", "SerializedTS") + packet, "SerializedTS"},
      {aedat3_header("", "SerializedTS,PNGFrames") + packet, "SerializedTS,PNGFrames"},
      {"#!AER-DAT3.1\n#!END-HEADER\n", "#!END-HEADER"},
      {"#!AER-DAT3.1\r\n#Format: RAW\r\n" + packet, "#!END-HEADER"},
      {"#!AER-DAT3.1\r\n#" + std::string(20'000'000, 'x'), "can't be"},
      {aedat3_davis_header(), "ends with its header"},
  }));
  CHECK_THAT(aedat3_refusal(bytes), Contains("failure: ") && Contains("recording: ") && Contains(what));
}

}  // namespace esi::test
