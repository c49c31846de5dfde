#include "esi/sweep/cell_record.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const std::vector<Phase> kPhases{{"a", {0, 100}}, {"b", {200, 1000}}};

CellRecord record_at(const std::vector<std::int64_t>& times_us, unsigned bits) {
  CellRecord record{7, 2, 1, {}, {{3, 4, 0.5}, {0, 0, 0.0}}};
  for (std::size_t i = 0; i < times_us.size(); ++i) {
    record.frames.push_back({times_us[i], times_us[i] < 100 ? 0U : 1U, ((bits >> i) & 1U) != 0});
  }
  return record;
}

void check_same(const CellRecord& a, const CellRecord& b) {
  CHECK(a.cell == b.cell);
  CHECK(a.recording == b.recording);
  CHECK(a.round == b.round);
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    CHECK(a.frames[i].t_us == b.frames[i].t_us);
    CHECK(a.frames[i].phase == b.frames[i].phase);
    CHECK(a.frames[i].is_detected == b.frames[i].is_detected);
  }
  REQUIRE(a.phases.size() == b.phases.size());
  for (std::size_t i = 0; i < a.phases.size(); ++i) {
    CHECK(a.phases[i].wrong == b.phases[i].wrong);
    CHECK(a.phases[i].corners == b.phases[i].corners);
    CHECK(a.phases[i].corner_error_px == b.phases[i].corner_error_px);
  }
}

}  // namespace

TEST_CASE("A record comes back from its line as it was, with frames evenly spaced or not") {
  for (const auto& times : std::vector<std::vector<std::int64_t>>{
           {}, {50}, {10, 20, 30, 40, 50, 60, 70, 80, 90}, {10, 20, 30, 210, 215}}) {
    for (const unsigned bits : {0U, 1U, 0x155U, 0x1ffU}) {
      const CellRecord record = record_at(times, bits);
      check_same(record_from(json::parse(to_json(record).dump()), kPhases), record);
    }
  }
}

TEST_CASE("Evenly spaced frames take a bit each") {
  const json line = to_json(record_at({10, 20, 30, 40, 50}, 0b10011));
  CHECK(line["first_us"] == 10);
  CHECK(line["every_us"] == 10);
  CHECK(line["detected"] == "c8");  // the first frame is the highest bit
}

TEST_CASE("A line that can't be a record is refused") {
  const auto changed = [](const char* key, const json& value) {
    json line = to_json(record_at({10, 20, 30}, 1));
    line[key] = value;
    return line;
  };
  CHECK_THROWS_AS(record_from(changed("detected", "cc"), kPhases), Error);
  CHECK_THROWS_AS(record_from(changed("detected", "x"), kPhases), Error);
  CHECK_THROWS_AS(record_from(changed("frames", 1'000'000'000'000), kPhases), Error);
  CHECK_THROWS_AS(record_from(changed("every_us", "x"), kPhases), Error);
  CHECK_THROWS_WITH(record_from(changed("first_us", 150), kPhases), Contains("none of the phases"));
  CHECK_THROWS_WITH(record_from(changed("phases", json::array()), kPhases), Contains("number of phases"));
  CHECK_THROWS_AS(record_from(json::array(), kPhases), Error);
}
