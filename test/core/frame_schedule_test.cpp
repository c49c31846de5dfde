#include "esi/core/frame_schedule.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "esi/core/error.hpp"

using namespace esi;

namespace {

std::vector<Event> events_at(const std::vector<std::int64_t>& times_us) {
  std::vector<Event> events;
  for (const std::int64_t t_us : times_us) events.push_back({t_us, 0, 0, true});
  return events;
}

struct Shown {
  std::int64_t t_us;
  std::int64_t events;
  friend bool operator==(const Shown&, const Shown&) = default;
};

std::ostream& operator<<(std::ostream& out, const Shown& shown) {
  return out << "{" << shown.t_us << " us, " << shown.events << " events}";
}

// Drives a schedule as the pipeline does, with the events cut into packets of the given size.
std::vector<Shown> run(FrameSchedule& schedule, std::span<const Event> events, std::size_t packet_size) {
  std::vector<Shown> frames;
  std::int64_t left = 0;
  for (std::size_t begin = 0; begin < events.size(); begin += packet_size) {
    auto packet = events.subspan(begin, std::min(packet_size, events.size() - begin));
    while (const auto cut = schedule.next(packet)) {
      frames.push_back({cut->t_us, left + static_cast<std::int64_t>(cut->events)});
      left = 0;
      packet = packet.subspan(cut->events);
    }
    left += static_cast<std::int64_t>(packet.size());
  }
  const auto t_last_us = events.empty() ? std::nullopt : std::optional(events.back().t_us);
  while (const auto cut = schedule.last(t_last_us)) frames.push_back({cut->t_us, std::exchange(left, 0)});
  return frames;
}

}  // namespace

TEST_CASE("a frame of a fixed rate shows exactly the events before it") {
  const auto events = events_at({0, 9999, 10000, 10001, 19999, 40000});
  const auto packet_size = GENERATE(1u, 2u, 3u, 100u);
  FixedRate schedule(100, 0);
  const std::vector<Shown> expected = {{10000, 2}, {20000, 3}, {30000, 0}, {40000, 0}, {50000, 1}};
  CHECK(run(schedule, events, packet_size) == expected);
}

TEST_CASE("there are floor((t_last - t0) / P) + 1 frames") {
  struct Row {
    std::int64_t t_last_us;
    std::size_t frames;
  };
  const auto row = GENERATE(Row{0, 1}, Row{9999, 1}, Row{10000, 2}, Row{999996, 100}, Row{1000000, 101});
  FixedRate schedule(100, 0);
  CHECK(run(schedule, events_at({row.t_last_us}), 10).size() == row.frames);
}

TEST_CASE("a recording that ends before the schedule begins has no frames") {
  FixedRate schedule(100, 5000000);
  CHECK(run(schedule, events_at({1, 2, 3}), 2).empty());
}

TEST_CASE("rates that do not divide a second do not drift") {
  const FixedRate thirty(30, 0);
  CHECK(thirty.due_us(0) == 33334);  // the first whole microsecond not before 33333.3
  CHECK(thirty.due_us(2) == 100000);
  CHECK(thirty.due_us(30LL * 3600 * 24 * 30 - 1) == 1000000LL * 3600 * 24 * 30);
  const FixedRate odd(29.97, 7);
  CHECK(odd.due_us(2996) == 7 + 100000000);  // 2997 frames in 100 s
  CHECK(odd.due_us(2996999) == 7 + 100000000000);
}

TEST_CASE("the number of frames before a time agrees with the frames that are made") {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const double fps = std::uniform_real_distribution(0.5, 2000.0)(random);
    const auto t_us = std::uniform_int_distribution<std::int64_t>(0, 300000)(random);
    const FixedRate schedule(fps, 0);
    FixedRate used(fps, 0);
    const auto made = run(used, events_at({0, t_us}), 10).size();
    CHECK(static_cast<std::int64_t>(made) == schedule.frames_before(t_us) + 1);
  }
}

TEST_CASE("impossible rates are refused") {
  const double fps = GENERATE(0.0, -1.0, 1e-7, 2e6);
  CHECK_THROWS_AS(FixedRate(fps, 0), Error);
}

TEST_CASE("a frame every n events keeps events of one microsecond together") {
  const auto events = events_at({1, 2, 2, 2, 5, 6, 7, 7, 9});
  const auto packet_size = GENERATE(1u, 2u, 3u, 4u, 100u);
  EveryNEvents schedule(2);
  const std::vector<Shown> expected = {{3, 4}, {7, 2}, {8, 2}, {10, 1}};
  CHECK(run(schedule, events, packet_size) == expected);
}

TEST_CASE("a frame every n events: all at one time are one frame") {
  EveryNEvents schedule(3);
  const std::vector<Shown> expected = {{5, 7}};
  CHECK(run(schedule, events_at({4, 4, 4, 4, 4, 4, 4}), 2) == expected);
}

TEST_CASE("frames at given times show the events before each, and those behind the end are due as well") {
  const auto packet_size = GENERATE(1u, 3u, 100u);
  AtTimes schedule({0, 5, 5, 8, 100});
  const std::vector<Shown> expected = {{0, 0}, {5, 2}, {5, 0}, {8, 2}, {100, 1}};
  CHECK(run(schedule, events_at({1, 4, 5, 7, 8}), packet_size) == expected);
}

TEST_CASE("frames at the ends of packets follow what the file says") {
  AtPacketEnds schedule;
  schedule.add_packet_ends(std::vector<std::int64_t>{5, 9});
  CHECK(run(schedule, events_at({1, 4, 5, 7, 8}), 2) == std::vector<Shown>{{5, 2}, {9, 3}});
}

TEST_CASE(
    "frames at intensity frames are due at their exposures' ends, and a late one as soon as it can be") {
  AtIntensityFrames schedule;
  schedule.add_packet_ends(std::vector<std::int64_t>{2});  // these are others' concern
  schedule.add_exposure_end(5);
  const std::vector<Event> first = events_at({1, 4, 5, 5});
  const auto cut = schedule.next(first);
  REQUIRE(cut);
  CHECK(cut->events == 2);
  CHECK(cut->t_us == 5);
  CHECK_FALSE(schedule.next(std::span(first).subspan(2)));
  schedule.add_exposure_end(3);  // events up to 5 have been taken
  schedule.add_exposure_end(9);
  const std::vector<Event> second = events_at({5, 7});
  const auto late = schedule.next(second);
  REQUIRE(late);
  CHECK(late->events == 1);
  CHECK(late->t_us == 6);
  CHECK_FALSE(schedule.next(std::span(second).subspan(1)));
  CHECK(schedule.last(7)->t_us == 9);
  CHECK_FALSE(schedule.last(7));
}
