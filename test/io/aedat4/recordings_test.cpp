// Real recordings against numbers that other parsers found.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_digest.hpp"
#include "io/aedat4/read_aedat4.hpp"
#include "support/shared_data.hpp"

namespace esi::test {
namespace {

const char* const kRecordings[] = {"aedat4/aestream_davis.aedat4", "aedat4/cuke-emlb_demo-01.aedat4",
                                   "aedat4/redpob_dvSave-2024_06_13_16_16_25.aedat4",
                                   "aedat4/tonic_sample.aedat4"};

}  // namespace

TEST_CASE("Every real AEDAT 4 recording has the digest that other parsers found") {
  const std::string name = GENERATE(from_range(std::begin(kRecordings), std::end(kRecordings)));
  const auto path = shared_data(name);
  const auto digests = shared_data("digests.json");
  if (!path || !digests) return;
  INFO(name);
  std::ifstream file(*digests);
  const auto expected = nlohmann::json::parse(file).at(name);

  const FormatReading content = read_aedat4(*path);
  EventDigest digest;
  digest.add(content.all.events);
  CHECK(content.header.sensor == SensorSize{expected.at("width"), expected.at("height")});
  CHECK(digest.events() == expected.at("events"));
  CHECK(digest.t_first_us() == expected.at("t_first_us"));
  CHECK(digest.duration_us() == expected.at("duration_us"));
  CHECK(digest.sum_x() == expected.at("sum_x"));
  CHECK(digest.sum_y() == expected.at("sum_y"));
  CHECK(digest.on() == expected.at("on"));
  CHECK(digest.crc32() == expected.at("crc32"));
  CHECK(content.header.layout == "AEDAT 4, LZ4");
  CHECK(content.notes().empty());
  CHECK(content.losses.text().empty());
  CHECK(content.most_events_at_once <= kPacketEvents);
}

TEST_CASE("Real AEDAT 4 recordings keep their intensity frames and packets") {
  struct Row {
    const char* name;
    std::size_t frames;
    Interval first_exposure;
    std::int64_t exposure_us;
    double sum_of_pixels;
    std::size_t packets;
    std::int64_t first_packet_end_us, last_packet_end_us;
  };
  const auto row =
      GENERATE(Row{"aedat4/aestream_davis.aedat4",
                   3,
                   {1633953690976518, 1633953690981291},
                   4773,
                   13809230,
                   13,
                   1633953690985950,
                   1633953691105950},
               Row{"aedat4/cuke-emlb_demo-01.aedat4",
                   13,
                   {1643243628757800, 1643243628777800},
                   20000,
                   28839868,
                   511,
                   1643243628738084,
                   1643243629248084},
               Row{"aedat4/tonic_sample.aedat4", 0, {}, 0, 0, 59, 1605537493728246, 1605537494308263});
  const auto path = shared_data(row.name);
  if (!path) return;
  INFO(row.name);

  const FormatReading content = read_aedat4(*path);
  CHECK(content.header.has_intensity_frames == (row.frames > 0));
  REQUIRE(content.all.frames.size() == row.frames);
  double sum_of_pixels = 0;
  for (const IntensityFrame& frame : content.all.frames) {
    CHECK(frame.exposure.duration_us() == row.exposure_us);
    CHECK(frame.image.type() == CV_8UC1);
    CHECK(frame.image.size() == cv::Size(346, 260));
    sum_of_pixels += cv::sum(frame.image)[0];
  }
  CHECK(sum_of_pixels == row.sum_of_pixels);
  if (row.frames > 0) CHECK(content.all.frames.front().exposure == row.first_exposure);
  CHECK(content.header.has_packets);
  REQUIRE(content.all.packet_ends_us.size() == row.packets);
  CHECK(content.all.packet_ends_us.front() == row.first_packet_end_us);
  CHECK(content.all.packet_ends_us.back() == row.last_packet_end_us);
}

TEST_CASE("A real AEDAT 4 recording cut anywhere gives the events up to the cut") {
  const auto path = shared_data("aedat4/redpob_dvSave-2024_06_13_16_16_25.aedat4");
  if (!path) return;
  constexpr std::size_t packets_begin = 1638, table = 208131;  // read off the file by hand
  const std::string whole = content_of(*path);
  const std::vector<Event> events = read_aedat4(*path).all.events;
  std::size_t before = 0;
  for (std::size_t length = 1; length < whole.size(); length += 4999) {
    INFO("first " << length << " bytes");
    if (length < packets_begin) {
      CHECK_THROWS_AS(read_aedat4_bytes(whole.substr(0, length)), Error);
      continue;
    }
    const FormatReading cut = read_aedat4_bytes(whole.substr(0, length));
    const auto& got = cut.all.events;
    REQUIRE(got.size() <= events.size());
    CHECK(std::equal(got.begin(), got.end(), events.begin()));
    CHECK((got.size() > before || got.size() == events.size()));
    CHECK(cut.losses.of(Damage::cut_packet) == (length < table ? 1 : 0));
    CHECK(cut.losses.any() == (length < table));
    before = got.size();
  }
  CHECK(before == events.size());
}

}  // namespace esi::test
