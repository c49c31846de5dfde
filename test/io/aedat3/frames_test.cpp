#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "io/aedat3/read_aedat3.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

constexpr std::uint32_t info_of(std::uint32_t channels) { return 1U | channels << 1; }

/// Of a sensor of 4x3 px, pixel i has value 5000 i.
Aedat3FrameEvent whole_frame() {
  Aedat3FrameEvent frame;
  frame.width_px = 4;
  frame.height_px = 3;
  for (int i = 0; i < 12; ++i) frame.pixels.push_back(static_cast<std::uint16_t>(5000 * i));
  return frame;
}

const std::string kHeader = aedat3_header("#Source 1: File,dvsSizeX=4,dvsSizeY=3,apsSizeX=4,apsSizeY=3\r\n");

FormatReading read_frame(const Aedat3FrameEvent& frame) {
  return read_aedat3_bytes(kHeader + aedat3_frame_packet(frame) + aedat3_packet(some_aedat3_events(9000, 2)));
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace

TEST_CASE("An AEDAT 3.1 frame keeps its 16-bit pixels, row by row, and its exposure") {
  const FormatReading content = read_aedat3_bytes(kHeader + aedat3_frame_packet(whole_frame(), 3));
  REQUIRE(content.all.frames.size() == 1);
  const cv::Mat expected = (cv::Mat_<ushort>(3, 4) << 0, 5000, 10000, 15000, 20000, 25000, 30000, 35000,
                            40000, 45000, 50000, 55000);
  CHECK(equal(content.all.frames[0].image, expected));
  const std::int64_t upper_us = std::int64_t{3} << 31;
  CHECK(content.all.frames[0].exposure == Interval{upper_us + 1000, upper_us + 1200});
  CHECK(content.all.packet_ends_us.empty());
  CHECK(content.losses.text().empty());
  CHECK(content.notes().empty());
}

TEST_CASE("An AEDAT 3.1 frame whose exposure does not last has only a time") {
  Aedat3FrameEvent frame = whole_frame();
  frame.start_of_exposure = GENERATE(1200, 1201);
  const FormatReading content = read_frame(frame);
  REQUIRE(content.all.frames.size() == 1);
  CHECK(content.all.frames[0].exposure == Interval{1200, 1200});
}

TEST_CASE("Colour frames of AEDAT 3.1 become grey, red first") {
  const auto [channels, pixel, grey] = GENERATE(table<std::uint32_t, std::vector<std::uint16_t>, double>(
      {{3, {60000, 0, 0}, 17940}, {3, {0, 0, 60000}, 6840}, {4, {0, 60000, 0, 9}, 35220}}));
  Aedat3FrameEvent frame = whole_frame();
  frame.info = info_of(channels);
  frame.pixels.clear();
  for (int i = 0; i < 12; ++i) frame.pixels.insert(frame.pixels.end(), pixel.begin(), pixel.end());
  const FormatReading content = read_frame(frame);
  REQUIRE(content.all.frames.size() == 1);
  CHECK(cv::norm(content.all.frames[0].image, cv::Mat(3, 4, CV_16UC1, cv::Scalar(grey)), cv::NORM_INF) <= 1);
}

TEST_CASE("An AEDAT 3.1 frame of a part of the sensor stands at its place") {
  Aedat3FrameEvent frame = whole_frame();
  frame.width_px = 2;
  frame.height_px = 1;
  frame.x_px = 1;
  frame.y_px = 2;
  frame.pixels = {10, 11};
  const FormatReading content = read_frame(frame);
  REQUIRE(content.all.frames.size() == 1);
  const cv::Mat expected = (cv::Mat_<ushort>(3, 4) << 0, 0, 0, 0, 0, 0, 0, 0, 0, 10, 11, 0);
  CHECK(equal(content.all.frames[0].image, expected));
}

TEST_CASE("A frame that the camera marked as invalid is no loss") {
  Aedat3FrameEvent frame = whole_frame();
  frame.info &= ~1U;
  const FormatReading content = read_frame(frame);
  CHECK(content.all.frames.empty());
  CHECK(content.all.events.size() == 2);
  CHECK(content.losses.text().empty());
}

TEST_CASE("A damaged frame of AEDAT 3.1 is left out and counted, what follows is read") {
  Aedat3FrameEvent frame = whole_frame();
  SECTION("more pixels than bytes") { frame.height_px = 4; }
  SECTION("pixels that overflow") { frame.width_px = frame.height_px = INT32_MAX; }
  SECTION("no width") { frame.width_px = 0; }
  SECTION("a negative height") { frame.height_px = -3; }
  SECTION("two channels") { frame.info = info_of(2); }
  SECTION("no channels") { frame.info = info_of(0); }
  SECTION("more channels than bytes") { frame.info = info_of(3); }
  SECTION("left of the sensor") { frame.x_px = -1; }
  SECTION("below the sensor") { frame.y_px = 1; }
  SECTION("far to the right") { frame.x_px = INT32_MAX; }
  SECTION("no pixels") { frame.pixels.clear(); }
  const FormatReading content = read_frame(frame);
  CHECK(content.all.frames.empty());
  CHECK(content.all.events.size() == 2);
  CHECK(content.losses.text() == "1 corrupt_packet");
  CHECK_THAT(content.notes(), Contains("A frame in the packet at byte") && Contains("damaged"));
}

TEST_CASE("A small frame on a huge sensor is not believed") {
  Aedat3FrameEvent frame = whole_frame();
  const std::string header = aedat3_header("#Source 1: File,dvsSizeX=30000,dvsSizeY=30000\r\n");
  const FormatReading content = read_aedat3_bytes(header + aedat3_frame_packet(frame));
  CHECK(content.all.frames.empty());
  CHECK(content.losses.text() == "1 corrupt_packet");
}

}  // namespace esi::test
