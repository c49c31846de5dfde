#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "io/aedat4/read_aedat4.hpp"

namespace esi::test {
namespace {

// A sensor of 4x3 px whose frame stream is 1.
Aedat4File frame_file(std::string_view frame_size = "4x3", std::string_view frame_source = "DAVIS346_1") {
  return {Aedat4Compression::lz4, aedat4_xml(aedat4_stream_xml(0, "EVTS", "4x3") +
                                             aedat4_stream_xml(1, "FRME", frame_size, frame_source))};
}

/// A whole frame of a sensor of 4x3 px, pixel i has value i.
Aedat4Frame whole_frame() {
  Aedat4Frame frame;
  frame.t_us = 1000;
  frame.width_px = 4;
  frame.height_px = 3;
  for (char i = 0; i < 12; ++i) frame.pixels += i;
  return frame;
}

FormatReading read_frame(const Aedat4Frame& frame) {
  Aedat4File file = frame_file();
  file.add(1, aedat4_frame_buffer(frame));
  return read_aedat4_bytes(file.bytes());
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// All pixels of a 4x3 image alike.
Aedat4Frame uniform_frame(std::int8_t format, const std::string& pixel) {
  Aedat4Frame frame = whole_frame();
  frame.format = format;
  frame.pixels.clear();
  for (int i = 0; i < 12; ++i) frame.pixels += pixel;
  return frame;
}

}  // namespace

TEST_CASE("An AEDAT 4 frame keeps its pixels, row by row") {
  const FormatReading content = read_frame(whole_frame());
  REQUIRE(content.all.frames.size() == 1);
  const cv::Mat expected = (cv::Mat_<uchar>(3, 4) << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11);
  CHECK(equal(content.all.frames[0].image, expected));
  CHECK(content.header.has_intensity_frames);
  CHECK(content.losses.text().empty());
  CHECK(content.all.packet_ends_us.empty());
}

TEST_CASE("An AEDAT 4 frame's exposure is taken from the best times that it has") {
  struct Row {
    std::optional<std::int64_t> start_us, end_us, exposure_us;
    Interval expected;
  };
  const std::optional<std::int64_t> none;
  const auto row = GENERATE_COPY(Row{900, 1100, none, {900, 1100}}, Row{900, 1100, 50, {900, 1100}},
                                 Row{none, none, 200, {1000, 1200}}, Row{0, 0, 200, {1000, 1200}},
                                 Row{1100, 900, 200, {1000, 1200}}, Row{0, 1100, none, {1000, 1000}},
                                 Row{none, none, none, {1000, 1000}}, Row{none, none, -5, {1000, 1000}});
  Aedat4Frame frame = whole_frame();
  frame.start_of_exposure_us = row.start_us;
  frame.end_of_exposure_us = row.end_us;
  frame.exposure_us = row.exposure_us;
  const FormatReading content = read_frame(frame);
  REQUIRE(content.all.frames.size() == 1);
  CHECK(content.all.frames[0].exposure == row.expected);
}

TEST_CASE("AEDAT 4 frames of 16 bits keep them, colour becomes grey") {
  using namespace std::string_literals;
  struct Row {
    std::int8_t format;
    std::string pixel;
    int type;
    double grey;
  };
  // 0.299 R + 0.587 G + 0.114 B, stored blue first.
  const auto row = GENERATE(Row{0, "\x80"s, CV_8UC1, 128}, Row{2, "\x34\x12"s, CV_16UC1, 0x1234},
                            Row{16, "\xff\x00\x00"s, CV_8UC1, 29}, Row{16, "\x00\x00\xff"s, CV_8UC1, 76},
                            Row{24, "\x00\xff\x00\x07"s, CV_8UC1, 150},
                            Row{18, "\x00\x00\x00\x00\x00\x80"s, CV_16UC1, 9798});
  const FormatReading content = read_frame(uniform_frame(row.format, row.pixel));
  REQUIRE(content.all.frames.size() == 1);
  CHECK(equal(content.all.frames[0].image, cv::Mat(3, 4, row.type, cv::Scalar(row.grey))));
}

TEST_CASE("An AEDAT 4 frame of a part of the sensor stands at its place") {
  Aedat4Frame frame = whole_frame();
  frame.width_px = 2;
  frame.height_px = 1;
  frame.x_px = 1;
  frame.y_px = 2;
  frame.pixels = "\x0a\x0b";
  const FormatReading content = read_frame(frame);
  REQUIRE(content.all.frames.size() == 1);
  const cv::Mat expected = (cv::Mat_<uchar>(3, 4) << 0, 0, 0, 0, 0, 0, 0, 0, 0, 10, 11, 0);
  CHECK(equal(content.all.frames[0].image, expected));
}

TEST_CASE("An AEDAT 4 frame that can't be right is left out, and the events go on") {
  const auto change = GENERATE(table<const char*, void (*)(Aedat4Frame&)>({
      {"a pixel too few", [](Aedat4Frame& f) { f.pixels.pop_back(); }},
      {"too few bytes for its format", [](Aedat4Frame& f) { f.format = 16; }},
      {"right of the sensor", [](Aedat4Frame& f) { f.x_px = 1; }},
      {"below the sensor", [](Aedat4Frame& f) { f.y_px = 1; }},
      {"left of the sensor", [](Aedat4Frame& f) { f.x_px = -1; }},
      {"no width", [](Aedat4Frame& f) { f.width_px = 0; }},
      {"negative sides", [](Aedat4Frame& f) { f.width_px = f.height_px = -1; }},
      {"a format of two channels", [](Aedat4Frame& f) { f.format = 8; f.pixels += f.pixels; }},
      {"floating point", [](Aedat4Frame& f) { f.format = 5; f.pixels.resize(48); }},
      {"a negative format", [](Aedat4Frame& f) { f.format = -128; }},
      {"a time after the sun's death", [](Aedat4Frame& f) { f.t_us = INT64_MAX; f.exposure_us = INT64_MAX; }},
      {"an exposure that overflows", [](Aedat4Frame& f) { f.exposure_us = INT64_MAX; }},
      {"a start of all times", [](Aedat4Frame& f) { f.start_of_exposure_us = INT64_MIN; }},
      {"an end of all times", [](Aedat4Frame& f) { f.end_of_exposure_us = INT64_MAX; }},
  }));
  INFO(std::get<0>(change));
  Aedat4Frame frame = whole_frame();
  std::get<1>(change)(frame);
  Aedat4File file = frame_file();
  file.add(1, aedat4_frame_buffer(frame));
  file.add(0, aedat4_event_buffer({{1, 1, 1, 1}}));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.frames.empty());
  CHECK(content.all.events.size() == 1);
  CHECK(content.losses.text() == "1 corrupt_packet");
}

TEST_CASE("AEDAT 4 frames of another camera are left out, and that is said") {
  const auto [size, source] =
      GENERATE(table<const char*, const char*>({{"640x480", "DAVIS346_1"}, {"4x3", "FLIR_1"}}));
  Aedat4File file = frame_file(size, source);
  file.add(1, aedat4_frame_buffer(whole_frame()));
  file.add(0, aedat4_event_buffer({{1, 1, 1, 1}}));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.frames.empty());
  CHECK(content.all.events.size() == 1);
  CHECK_FALSE(content.header.has_intensity_frames);
  CHECK_THAT(content.notes(), Catch::Contains("another camera"));
  CHECK(content.losses.text().empty());
}

TEST_CASE("A small AEDAT 4 frame on an absurd sensor does not become an absurd image") {
  Aedat4File file(Aedat4Compression::lz4,
                  aedat4_xml(aedat4_stream_xml(0, "EVTS", "32768x32768") + aedat4_stream_xml(1, "FRME", "")));
  file.add(1, aedat4_frame_buffer(whole_frame()));
  const FormatReading content = read_aedat4_bytes(file.bytes());
  CHECK(content.all.frames.empty());
  CHECK(content.losses.text() == "1 corrupt_packet");
}

TEST_CASE("One read() gives at most one AEDAT 4 frame, with the events before it") {
  Aedat4File file = frame_file();
  file.add(0, aedat4_event_buffer({{1, 1, 1, 1}}));
  for (int i = 0; i < 3; ++i) file.add(1, aedat4_frame_buffer(whole_frame()));
  const TempFolder folder;
  const auto reader = open_aedat4(std::make_unique<ByteSource>(folder.write("f.aedat4", file.bytes())), {});
  Packet packet;
  Losses losses;
  REQUIRE(reader->read(packet, losses));
  CHECK(packet.events.size() == 1);
  CHECK(packet.frames.size() == 1);
  REQUIRE(reader->read(packet, losses));
  CHECK(packet.frames.size() == 2);
}

}  // namespace esi::test
