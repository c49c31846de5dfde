// Real recordings against numbers that other parsers found.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "esi/io/event_digest.hpp"
#include "esi/io/event_source.hpp"
#include "esi/io/prophesee/dat_reader.hpp"
#include "esi/io/prophesee/raw_reader.hpp"
#include "support/read_format.hpp"
#include "support/scripted_reader.hpp"
#include "support/shared_data.hpp"

namespace esi::test {
namespace {

struct Row {
  const char* name;
  OpenFormat open;
  const char* layout;
  bool has_size;
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

TEST_CASE("every real Prophesee recording has the digest that other parsers found") {
  const auto row =
      GENERATE(Row{"raw_evt/expelliarmus_evt2_sample.raw", open_prophesee_raw, "Prophesee RAW, EVT2", true},
               Row{"raw_evt/expelliarmus_evt3_sample.raw", open_prophesee_raw, "Prophesee RAW, EVT3", true},
               Row{"dat/NCARS_obj_004397_td.dat", open_prophesee_dat, "Prophesee DAT", false});
  const auto path = shared_data(row.name);
  const auto digests = shared_data("digests.json");
  if (!path || !digests) return;
  CAPTURE(row.name);
  std::ifstream file(*digests);
  const auto expected = nlohmann::json::parse(file).at(row.name);
  const SensorSize size{expected.at("width"), expected.at("height")};

  const FormatReading reading = read_with(row.open, *path);
  EventDigest digest;
  digest.add(reading.all.events);
  check_digest(digest, expected);
  CHECK(digest.t_first_us() == expected.at("t_first_us"));
  CHECK(reading.header.layout == row.layout);
  CHECK(reading.header.sensor == (row.has_size ? std::optional(size) : std::nullopt));
  CHECK(digest.max_x() < size.width_px);
  CHECK(digest.max_y() < size.height_px);
  CHECK(reading.losses.text().empty());
  CHECK(reading.most_events_at_once < 2 * kPacketEvents);

  // The same by way of the format table and the gate.
  EventDigest gated;
  const auto source = open_recording(*path, {});
  gated.add(drain(*source).events);
  check_digest(gated, expected);
  CHECK_FALSE(source->losses().any());
}

}  // namespace esi::test
