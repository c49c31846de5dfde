#include "esi/io/check/recording_check.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/io/event_gate.hpp"
#include "support/scripted_reader.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

/// A quiet scene of 1 s with one event every 0.1 ms on 100 x 100 px, half of them ON.
std::vector<Event> quiet_scene() {
  std::vector<Event> events;
  for (std::int64_t i = 0; i < 10000; ++i) {
    events.push_back({100 * i, static_cast<std::uint16_t>(i % 100), static_cast<std::uint16_t>(i / 100 % 100),
                      i % 2 == 0});
  }
  return events;
}

struct Checked {
  CheckReport report;
  RecordingInfo info;
};

Checked check(const std::vector<Event>& events) {
  EventGate gate(std::make_unique<ScriptedReader>(packets_of(events, 777)), {}, "rec");
  Checked checked;
  checked.report = check_recording(gate, checked.info);
  return checked;
}

}  // namespace

TEST_CASE("a good recording has no findings") {
  const Checked checked = check(quiet_scene());
  CAPTURE(checked.report.findings);
  CHECK(checked.report.is_good());
  CHECK(checked.info.digest.events() == 10000);
  const auto json = to_json(checked.report, checked.info);
  CHECK(json["good"] == true);
  CHECK(json["on_share"] == 0.5);
  CHECK(json["hot_pixels"].empty());
  CHECK_THAT(to_text(checked.report), Contains("verdict      good"));
}

TEST_CASE("what is wrong with a recording is found and said") {
  std::vector<Event> events = quiet_scene();
  for (Event& event : events) event.on = event.t_us % 2000 == 0;  // 5 % ON
  for (std::size_t i = 5000; i < events.size(); ++i) events[i].t_us += 250000;
  for (std::size_t i = 0; i < 3000; i += 3) events[i].x = 12, events[i].y = 40;
  std::swap(events[700].t_us, events[701].t_us);
  const Checked checked = check(events);
  REQUIRE(checked.report.findings.size() == 4);
  CHECK(checked.report.findings[0] == "damaged or out of range: 1 sorted_jitter");
  CHECK(checked.report.findings[1] == "1 pauses longer than 0.050 s, the longest 0.250 s at 0.499900 s");
  CHECK_THAT(checked.report.findings[2], Contains("1 hot pixels make 10.0"));
  CHECK_THAT(checked.report.findings[3], Contains("5.0 % of the events are ON"));
  CHECK(checked.report.gaps == std::vector<Interval>{{499900, 750000}});
  const auto json = to_json(checked.report, checked.info);
  CHECK(json["good"] == false);
  CHECK(json["hot_pixel_list"] == "12,40");
  CHECK(json["hot_pixels"][0]["x"] == 12);
  CHECK_THAT(to_text(checked.report), Contains("hot pixels   12,40\n") && Contains("FINDING") &&
                                          Contains("pause        0.499900 s to 0.750000 s"));
}
