// Real recordings against numbers that other parsers found.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "esi/io/recording_info.hpp"
#include "io/aedat2/read_aedat2.hpp"
#include "support/shared_data.hpp"

namespace esi::test {
namespace {

using Catch::Matchers::Contains;

struct Recording {
  const char* name;
  const char* layout;
  const char* note;
};
const Recording kRecordings[] = {
    {"aedat2/IMU_rotDisk.aedat", "AEDAT 2.0, DAVIS240", ""},
    {"aedat2/jaer_MovingDarkBox.aedat", "AEDAT 2.0, DVS128", "DVS128 is assumed"},
    {"aedat2/mibblez_foam90.aedat", "AEDAT 2.0, DVS128", ""},
    {"aedat2/checkerboard_1.aedat", "AEDAT 2.0, DVS128", "DVS128 is assumed"},
};

void check_digest(const EventDigest& digest, const nlohmann::json& expected) {
  CHECK(digest.events() == expected.at("events"));
  CHECK(digest.duration_us() == expected.at("duration_us"));
  CHECK(digest.sum_x() == expected.at("sum_x"));
  CHECK(digest.sum_y() == expected.at("sum_y"));
  CHECK(digest.on() == expected.at("on"));
  CHECK(digest.crc32() == expected.at("crc32"));
}

}  // namespace

TEST_CASE("Every real AEDAT 2 recording has the digest that other parsers found") {
  const Recording recording = GENERATE(from_range(std::begin(kRecordings), std::end(kRecordings)));
  const auto path = shared_data(recording.name);
  const auto digests = shared_data("digests.json");
  if (!path || !digests) return;
  INFO(recording.name);
  std::ifstream file(*digests);
  const auto expected = nlohmann::json::parse(file).at(recording.name);
  const SensorSize sensor{expected.at("width"), expected.at("height")};

  const FormatReading content = read_aedat2(*path);
  EventDigest digest;
  digest.add(content.all.events);
  check_digest(digest, expected);
  CHECK(digest.t_first_us() == expected.at("t_first_us"));
  CHECK(content.header.sensor == sensor);
  CHECK(content.header.layout == recording.layout);
  CHECK_THAT(content.notes(), Contains(recording.note));
  CHECK(content.header.notes.size() == (std::string(recording.note).empty() ? 0 : 1));
  CHECK(content.all.frames.empty());
  CHECK(content.losses.text().empty());

  const auto opened = open_recording(*path, {});
  const RecordingInfo info = inspect(*opened);
  check_digest(info.digest, expected);
  CHECK(info.t_first_us() == expected.at("t_first_us"));
  CHECK(info.sensor == sensor);
  CHECK(info.header.format == "aedat2");
  CHECK_FALSE(info.losses.any());
}

}  // namespace esi::test
