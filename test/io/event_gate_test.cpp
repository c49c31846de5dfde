#include "esi/io/event_gate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "esi/core/error.hpp"
#include "support/scripted_reader.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

EventGate gate_over(std::vector<Packet> packets, const ReadOptions& options = {},
                    RecordingHeader header = {}) {
  return {std::make_unique<ScriptedReader>(std::move(packets), std::move(header)), options, "rec"};
}

std::vector<Event> events_at(const std::vector<std::int64_t>& times_us) {
  std::vector<Event> events;
  events.reserve(times_us.size());
  for (const std::int64_t t_us : times_us) {
    events.push_back({t_us, static_cast<std::uint16_t>(events.size()), 0, true});
  }
  return events;
}

std::vector<std::int64_t> times_of(const std::vector<Event>& events) {
  std::vector<std::int64_t> times_us;
  times_us.reserve(events.size());
  for (const Event& event : events) times_us.push_back(event.t_us);
  return times_us;
}

IntensityFrame frame_over(Interval exposure) { return {exposure, cv::Mat1b(1, 1)}; }

}  // namespace

TEST_CASE("a good recording passes unchanged, however it is cut") {
  std::mt19937 random(7);
  std::vector<Event> events;
  for (std::int64_t t_us = 0; events.size() < 5000; t_us += std::uniform_int_distribution(0, 40)(random)) {
    events.push_back({t_us, static_cast<std::uint16_t>(random() % 300), 3, random() % 2 == 0});
  }
  const auto packet_size = GENERATE(1u, 17u, 1000u, 100000u);
  EventGate gate = gate_over(packets_of(events, packet_size));
  CHECK(drain(gate).events == events);
  CHECK_FALSE(gate.losses().any());
}

TEST_CASE("jitter is sorted across packets and counted, with ties in the file's order") {
  const auto packet_size = GENERATE(1u, 2u, 3u, 100u);
  EventGate gate = gate_over(packets_of(events_at({0, 1500, 1000, 1500, 2600, 2400, 1601}), packet_size));
  const Packet all = drain(gate);
  CHECK(times_of(all.events) == std::vector<std::int64_t>{0, 1000, 1500, 1500, 1601, 2400, 2600});
  CHECK(all.events[2].x == 1);
  CHECK(all.events[3].x == 3);
  CHECK(gate.losses().of(Damage::sorted_jitter) == 3);
  CHECK(gate.losses().dropped() == 0);
}

TEST_CASE("time that goes back by more than the jitter window is left out, by more than a second an error") {
  EventGate gate = gate_over(packets_of(events_at({0, 5000, 3999, 4000, 6000}), 2));
  CHECK(times_of(drain(gate).events) == std::vector<std::int64_t>{0, 4000, 5000, 6000});
  CHECK(gate.losses().of(Drop::backward_time) == 1);

  EventGate broken = gate_over(packets_of(events_at({0, 1000000, 2000000, 999999}), 1));
  CHECK_THROWS_WITH(drain(broken), Contains("rec: time goes back by 1000001 us"));
}

TEST_CASE("an event whose time strays far ahead is left out, wherever packets end") {
  struct Row {
    std::vector<std::int64_t> times_us, kept_us;
  };
  constexpr std::int64_t kYear_us = 31557600000000;
  const auto row =
      GENERATE(Row{{0, 10, kYear_us, 20, 30, 40}, {0, 10, 20, 30, 40}},
               Row{{kYear_us, 10, 20, 30}, {10, 20, 30}},  // the first of all
               Row{{0, 10, INT64_MAX, 20, 30, 40}, {0, 10, 20, 30, 40}},
               Row{{0, kYear_us, kYear_us + 5, 20, 30, 40, 50}, {0, 20, 30, 40, 50}},
               Row{{0, 10, 1000041, 20, 30}, {0, 10, 20, 30}},  // just more than the limit
               Row{{0, 10, kYear_us, kYear_us + 1}, {0, 10, kYear_us, kYear_us + 1}});  // a pause is none
  const auto packet_size = GENERATE(1u, 2u, 3u, 4u, 100u);
  if (packet_size < 3 && row.times_us[2] == kYear_us + 5) return;  // two in a row need a longer look ahead
  CAPTURE(row.times_us, packet_size);
  EventGate gate = gate_over(packets_of(events_at(row.times_us), packet_size));
  CHECK(times_of(drain(gate).events) == row.kept_us);
  CHECK(gate.losses().of(Drop::time_jump) ==
        static_cast<std::int64_t>(row.times_us.size() - row.kept_us.size()));
}

TEST_CASE("a clock that starts again is an error, not a stray") {
  std::vector<std::int64_t> times_us;
  for (std::int64_t i = 0; i < 2000; ++i) times_us.push_back(i % 1000 * 10000);
  EventGate gate = gate_over(packets_of(events_at(times_us), GENERATE(1u, 7u, 5000u)));
  CHECK_THROWS_WITH(drain(gate), Contains("time goes back by 9990000 us after event 1000"));
}

TEST_CASE("one event that goes back does not make strays of all that came after a pause") {
  EventGate gate = gate_over(packets_of(events_at({0, 10, 2000000, 2000010, 2000020, 2000030, 5}), 100));
  CHECK_THROWS_WITH(drain(gate), Contains("time goes back by 2000025 us after event 6"));
}

TEST_CASE("events outside the sensor are left out and counted, and too many are an error") {
  std::vector<Event> events(1000, Event{5, 9, 9, true});
  for (std::size_t i = 0; i < 10; ++i) events[i * 7].x = 10;
  ReadOptions options;
  options.size = "10x10";
  EventGate gate = gate_over(packets_of(events, 100), options);
  CHECK(drain(gate).events.size() == 990);
  CHECK(gate.losses().of(Drop::outside_sensor) == 10);

  events[500].y = 25;
  EventGate too_many = gate_over(packets_of(events, 100), options);
  CHECK_THROWS_WITH(drain(too_many), Contains("11 of 1000") && Contains("largest x is 10, the largest y 25"));
}

// Where the size is known most events take a shorter way through the gate.
TEST_CASE("a known sensor size changes nothing but what lies outside") {
  std::mt19937 random(GENERATE(1u, 2u, 3u, 4u));
  const auto between = [&](std::int64_t a, std::int64_t b) {
    return std::uniform_int_distribution(a, b)(random);
  };
  const std::int64_t first_us =
      GENERATE(std::int64_t{0}, std::int64_t{1722000000000000}, (std::int64_t{1} << 60) - 20000000);
  std::vector<Event> events;
  for (std::int64_t t_us = first_us; events.size() < 3000; t_us += between(0, 100)) {
    const std::int64_t kind = between(0, 299);
    const std::int64_t off_us = kind == 0   ? -between(1, 1000)
                                : kind == 1 ? -between(1001, 9000)
                                : kind == 2 ? between(1000001, 5000000)
                                            : 0;
    events.push_back({t_us + off_us, static_cast<std::uint16_t>(between(0, 19)), 7, between(0, 1) == 1});
    if (events.size() == 1500) t_us += 800000;  // a pause
  }
  const auto packet_size = GENERATE(1u, 100u, 4000u);
  EventGate plain = gate_over(packets_of(events, packet_size));
  RecordingHeader header;
  header.sensor = SensorSize{20, 8};
  EventGate sized = gate_over(packets_of(events, packet_size), {}, header);
  const Packet expected = drain(plain);
  CHECK(expected.events.size() > 2950);
  CHECK(plain.losses().of(Drop::backward_time) > 0);
  CHECK(plain.losses().of(Drop::time_jump) > 0);
  CHECK(drain(sized).events == expected.events);
  CHECK(sized.losses().text() == plain.losses().text());

  events.insert(events.begin() + 2000, {events[1999].t_us, 20, 7, true});
  events.insert(events.begin() + 2000, {events[1999].t_us, 3, 8, true});
  EventGate outside = gate_over(packets_of(events, packet_size), {}, header);
  CHECK(drain(outside).events == expected.events);
  CHECK(outside.losses().of(Drop::outside_sensor) == 2);
}

TEST_CASE("errors are the same where the sensor size is known") {
  RecordingHeader header;
  header.sensor = SensorSize{10, 1};
  EventGate backward = gate_over(packets_of(events_at({5, 10, 1000000, 1999999, 3}), 5), {}, header);
  CHECK_THROWS_WITH(drain(backward), Contains("goes back by 1999996 us after event 4 (at 1999999 us)"));
  EventGate absurd = gate_over(
      packets_of(events_at({(std::int64_t{1} << 60) - 2, (std::int64_t{1} << 60) + 1}), 2), {}, header);
  CHECK_THROWS_WITH(drain(absurd), Contains("can't be right"));
  auto wide = events_at({1, 2, 3, 4});
  wide[1].x = 9;
  wide[2].y = 1;
  EventGate outside = gate_over(packets_of(wide, 4), {}, header);
  CHECK_THROWS_WITH(drain(outside), Contains("the largest x is 9, the largest y 1"));
}

TEST_CASE("the option --size overrides the file's own sensor size; without either there is none") {
  RecordingHeader header;
  header.sensor = SensorSize{20, 20};
  ReadOptions options;
  CHECK(gate_over({}, options, header).sensor_size() == SensorSize{20, 20});
  options.size = "30x10";
  CHECK(gate_over({}, options, header).sensor_size() == SensorSize{30, 10});
  CHECK_FALSE(gate_over({}).sensor_size().has_value());
}

TEST_CASE("the clock's zero is the file's within an hour of the start, else the first event") {
  struct Row {
    std::int64_t t_first_us;
    TimeZero time_zero;
    std::int64_t zero_us;
  };
  constexpr std::int64_t kHour_us = 3600000000;
  const auto row = GENERATE(Row{5, TimeZero::automatic, 0}, Row{kHour_us - 1, TimeZero::automatic, 0},
                            Row{kHour_us, TimeZero::automatic, kHour_us}, Row{-5, TimeZero::automatic, 0},
                            Row{1744227144732712, TimeZero::automatic, 1744227144732712},
                            Row{1744227144732712, TimeZero::file, 0}, Row{5, TimeZero::first_event, 5});
  ReadOptions options;
  options.time_zero = row.time_zero;
  Packet packet;
  packet.events = events_at({row.t_first_us, row.t_first_us + 7});
  packet.frames = {frame_over({row.t_first_us - 3, row.t_first_us + 2})};
  packet.packet_ends_us = {row.t_first_us + 8};
  EventGate gate = gate_over({packet}, options);
  const Packet all = drain(gate);
  const std::int64_t first = row.t_first_us - row.zero_us;
  CHECK(gate.time_zero_us() == row.zero_us);
  CHECK(times_of(all.events) == std::vector<std::int64_t>{first, first + 7});
  REQUIRE(all.frames.size() == 1);
  CHECK(all.frames[0].exposure == Interval{first - 3, first + 2});
  CHECK(all.packet_ends_us == std::vector<std::int64_t>{first + 8});
}

TEST_CASE("intensity frames before the first event wait for the clock's zero") {
  Packet early, late;
  early.frames = {frame_over({9000000000, 9000000100})};
  late.events = events_at({9000000050, 9000005000});
  EventGate gate = gate_over({early, late});
  const Packet all = drain(gate);
  REQUIRE(all.frames.size() == 1);
  CHECK(all.frames[0].exposure == Interval{-50, 50});
}

TEST_CASE("intensity frames without any events do not pile up") {
  std::vector<Packet> packets(500);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const auto t_us = 9000000000 + static_cast<std::int64_t>(i);
    packets[i].frames = {frame_over({t_us, t_us})};
  }
  EventGate gate = gate_over(packets);
  Packet packet;
  std::size_t frames = 0;
  while (gate.next(packet)) {
    CHECK(packet.frames.size() <= 70);
    frames += packet.frames.size();
  }
  CHECK(frames == 500);
}

TEST_CASE("a flood of events at one time is passed on in bounded pieces") {
  const std::vector<Event> events(400000, Event{3, 1, 1, true});
  EventGate gate = gate_over(packets_of(events, 8192));
  Packet packet;
  std::size_t count = 0;
  while (gate.next(packet)) {
    CHECK(packet.events.size() < 200000);
    count += packet.events.size();
  }
  CHECK(count == events.size());
}

TEST_CASE("strict allows no loss") {
  ReadOptions options;
  options.strict = true;
  EventGate gate = gate_over(packets_of(events_at({0, 1000, 500}), 3), options);
  CHECK_THROWS_WITH(drain(gate), Contains("sorted_jitter") && Contains("--strict"));
}

TEST_CASE("absurd times are errors, not overflows") {
  const std::int64_t t_us = GENERATE(INT64_MAX, INT64_MIN, std::int64_t{1} << 61);
  EventGate first = gate_over(packets_of(events_at({t_us}), 1));
  CHECK_THROWS_WITH(drain(first), Contains("can't be right"));
  EventGate later = gate_over(packets_of(events_at({0, t_us}), 1));
  CHECK_THROWS_WITH(drain(later), Contains("can't be right") || Contains("goes back"));
}
