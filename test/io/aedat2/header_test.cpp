#include <catch2/catch.hpp>

#include "esi/io/camera_chip.hpp"
#include "io/aedat2/read_aedat2.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

bool is_recognised(const std::string& head) { return looks_like_aedat2(std::as_bytes(std::span(head))); }

/// Of a file with the header and one event at the corner that its chip counts as 0, 0.
Event corner_event(const std::string& header, const ReadOptions& options = {}) {
  return read_aedat2_bytes(header + aedat2_record(0, 7), options).all.events.at(0);
}

}  // namespace

TEST_CASE("AEDAT 2 is recognised by its first line") {
  CHECK(is_recognised("#!AER-DAT2.0\r\n"));
  CHECK(is_recognised("#!AER-DAT1.0\r\n"));
  const std::string other = GENERATE("", "#", "#!AER-DAT", "#!AER-DAT2", "#!AER-DAT3.1\r\n",
                                     "#!AER-DAT4.0\r\n", " #!AER-DAT2.0\r\n", "# 0.1 2 3 1\n");
  INFO(other);
  CHECK_FALSE(is_recognised(other));
}

TEST_CASE("The chip of an AEDAT 2 file gives the sensor") {
  const auto [chip, sensor] = GENERATE(table<const char*, SensorSize>({
      {"ch.unizh.ini.jaer.chip.retina.DVS128", {128, 128}},
      {"eu.seebetter.ini.chips.davis.DAVIS240A", {240, 180}},
      {"eu.seebetter.ini.chips.davis.DAVIS240C", {240, 180}},
      {"eu.seebetter.ini.chips.davis.Davis346blue", {346, 260}},
      {"eu.seebetter.ini.chips.davis.Davis346B", {346, 260}},
      {"eu.seebetter.ini.chips.davis.Davis346cBSI", {346, 260}},
      {"eu.seebetter.ini.chips.davis.Davis640", {640, 480}},
      {"eu.seebetter.ini.chips.davis.Davis208PixelParade", {208, 192}},
      {"eu.seebetter.ini.chips.davis.Davis128", {128, 128}},
      {"DAVIS346", {346, 260}},
  }));
  INFO(chip);
  const FormatReading content = read_aedat2_bytes(aedat2_header(chip) + aedat2_record(0, 7));
  CHECK(content.header.sensor == sensor);
  CHECK(content.all.events == std::vector<Event>{{7, static_cast<std::uint16_t>(sensor.width_px - 1),
                                                  static_cast<std::uint16_t>(sensor.height_px - 1),
                                                  std::string(chip).find("DVS128") != std::string::npos}});
  CHECK(content.notes().empty());
}

TEST_CASE("An AEDAT 2 file of an unknown chip asks for one whose addresses it shares") {
  const std::string chip =
      GENERATE("eu.seebetter.ini.chips.davis.DavisRGBW640", "net.sf.jaer.chip.Tmpdiff128",
               "eu.seebetter.ini.chips.davis.DAVIS640het", "DAVIS2400", "DVS1280", "x.");
  INFO(chip);
  const std::string file = aedat2_header(chip) + aedat2_record(0, 7);
  CHECK_THAT(aedat2_refusal(file), Contains("usage: ") && Contains("recording: ") &&
                                       Contains("'" + chip + "'") && Contains("--chip") &&
                                       Contains("--size") && Contains("DAVIS346"));
  CHECK(read_aedat2_bytes(file, with_chip("davis640")).header.sensor == SensorSize{640, 480});
}

TEST_CASE("The given chip goes before the one in an AEDAT 2 file's header, and with it the given size") {
  const std::string header = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");
  CHECK(corner_event(header, with_chip("", "640x480")) == Event{7, 239, 179, false});
  CHECK(corner_event(header, with_chip("DAVIS346")) == Event{7, 345, 259, false});
  CHECK(corner_event(header, with_chip("DAVIS346", "400x300")) == Event{7, 399, 299, false});
  CHECK(corner_event(header, with_chip("dvs128", "64x32")) == Event{7, 63, 31, true});
  const auto [chip, size] = GENERATE(table<std::string, std::string>(
      {{"DVS128", "129x128"}, {"DVS128", "128x129"}, {"DAVIS240", "1025x10"}, {"DAVIS240", "10x513"}}));
  CHECK_THAT(aedat2_refusal(header, with_chip(chip, size)), Contains("no events"));
  CHECK_THAT(aedat2_refusal(header + aedat2_record(0, 7), with_chip(chip, size)),
             Contains("usage: ") && Contains(size) && Contains(chip));
}

TEST_CASE("An AEDAT 2 file without chip is taken as of a DVS128 only where the addresses fit") {
  const std::string header = aedat2_header("");
  const std::string fitting = aedat2_record(0xFFFF, 6) + aedat2_record(0, 7);
  const FormatReading content = read_aedat2_bytes(header + fitting);
  CHECK(content.all.events == std::vector<Event>{{7, 127, 127, true}});
  CHECK(content.header.sensor == SensorSize{128, 128});
  CHECK_THAT(content.notes(), Contains("DVS128 is assumed"));
  CHECK(content.header.notes.size() == 1);

  const std::string davis = fitting + aedat2_record(0x10000, 8);
  CHECK_THAT(aedat2_refusal(header + davis),
             Contains("usage: ") && Contains("names no chip") && Contains("--chip"));
  const FormatReading chosen = read_aedat2_bytes(header + davis, with_chip("DAVIS240"));
  CHECK(chosen.header.sensor == SensorSize{240, 180});
  CHECK(chosen.notes().empty());
}

TEST_CASE("A number sign as the first byte of the data of an AEDAT 2 file is no header line") {
  const std::string header = aedat2_header("eu.seebetter.ini.chips.davis.DAVIS240C");
  // Rows 140 to 143 from the bottom make it 0x23. The others are text up to a byte of the time.
  const auto [address, t_us] = GENERATE(table<std::uint32_t, std::uint32_t>({{0x23000800, 1},
                                                                             {0x23000800, 0x0D0A},
                                                                             {0x23303030, 0x0D0A},
                                                                             {0x23303030, 0x300D300D},
                                                                             {0x23303030, 0x3030300A},
                                                                             {0x237F3B7F, 0x0D0A0D0A}}));
  INFO(std::hex << address << " " << t_us);
  const std::string more = aedat2_record(davis_address(1, 2, true), t_us + 5);
  const FormatReading content =
      read_aedat2_bytes(header + aedat2_record(address, t_us) + more, with_chip("DAVIS640", "1024x512"));
  REQUIRE(content.all.events.size() == 2);
  CHECK(content.all.events[0].t_us == t_us);
  CHECK(content.all.events[0].y == 511 - static_cast<int>(address >> 22));
  CHECK(content.losses.text().empty());
}

TEST_CASE("Long headers of AEDAT 2 files are read, endless ones refused") {
  std::string header = aedat2_header("");
  for (int i = 0; i < 3000; ++i)
    header += "#<entry key=\"\xc3\xa4\" value=\"" + std::string(70, 'v') + "\"/>\r\n";
  header += "#" + std::string(100'000, 'x') + "\r\n# AEChip: DAVIS240C\r\n#\r\n";
  CHECK(corner_event(header) == Event{7, 239, 179, false});
  const std::string endless = "#" + std::string(std::size_t{1} << 24, 'x');
  std::string lines;
  while (lines.size() < endless.size()) lines += "#" + std::string(1000, 'x') + "\r\n";
  CHECK_THAT(aedat2_refusal(aedat2_header("") + lines), Contains("failure: ") && Contains("can't be"));
  CHECK_THAT(aedat2_refusal(aedat2_header("") + endless + endless),
             Contains("failure: ") && Contains("can't be"));
}

TEST_CASE("An AEDAT 2 file that ends within or with its header, or is of another version, is refused") {
  const auto [bytes, what] = GENERATE(table<std::string, std::string>({
      {"#!AER-DAT2.0", "ends within its header, at byte 12"},
      {"#!AER-DAT2.0\r", "ends within its header, at byte 13"},
      {"#!AER-DAT2.0\r\n", "ends with its header, at byte 14"},
      {"#!AER-DAT2.0\r\n# AEC", "ends within its header, at byte 19"},
      {"#!AER-DAT2.0\n# AEChip: DVS128\n12345678", "does not end in CR LF"},
      {"#!AER-DAT2.1\r\n12345678", "AEDAT 2.1"},
      {"#!AER-DAT1.0\r\n123456", "AEDAT 1.0"},
  }));
  CHECK_THAT(aedat2_refusal(bytes), Contains("failure: ") && Contains("recording: ") && Contains(what));
}

TEST_CASE("The option chip takes the known names in upper and lower case") {
  ReadOptions options;
  OptionTable table = table_of(options);
  for (const std::string name : {"DVS128", "davis346", "Davis240", "DAVIS640", "davis208", "DAVIS128", ""}) {
    table.at("chip").set_text(name);
    CHECK(options.chip == name);
  }
  const std::string wrong = GENERATE("DAVIS240C", "EVK4", "DAVIS", "DVS", " DVS128");
  CHECK_THROWS_WITH(table.at("chip").set_text(wrong),
                    Contains("'" + wrong + "'") && Contains(camera_chip_names()));
}

}  // namespace esi::test
