#include "esi/recon/event_windows.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "support/random_events.hpp"

using namespace esi;

namespace {

/// All windows that were handed on.
struct Collected {
  std::vector<std::vector<Event>> windows;
  std::vector<std::vector<float>> weights;

  /// Windows as they are handed on, and their times.
  EventWindows::Take take_from(const EventWindows& from, std::vector<Interval>& times) {
    return [this, &from, &times](std::span<const Event> events, std::span<const float> given) {
      take()(events, given);
      times.push_back(from.last().value());
    };
  }

  EventWindows::Take take() {
    return [this](std::span<const Event> events, std::span<const float> given) {
      windows.emplace_back(events.begin(), events.end());
      weights.emplace_back(given.begin(), given.end());
    };
  }
};

std::vector<Event> events_at(const std::vector<std::int64_t>& times_us) {
  std::vector<Event> events;
  events.reserve(times_us.size());
  for (const std::int64_t t_us : times_us) events.push_back({t_us, 0, 0, true});
  return events;
}

}  // namespace

TEST_CASE("windows by count hold that many events each, the rest waits") {
  Collected collected;
  EventWindows windows = EventWindows::of_count(3);
  windows.add(events_at({0, 1, 1, 2, 5, 9, 9}), {}, collected.take());
  REQUIRE(collected.windows.size() == 2);
  CHECK(collected.windows[0] == events_at({0, 1, 1}));
  CHECK(collected.windows[1] == events_at({2, 5, 9}));
  windows.end_by(1000000, collected.take());
  CHECK(collected.windows.size() == 2);
}

TEST_CASE("windows of time are half-open, lie on the clock, and are left out where empty") {
  Collected collected;
  EventWindows windows = EventWindows::of_duration(10);
  windows.add(events_at({-11, -10, -1, 0, 9, 10, 45, 49}), {}, collected.take());
  REQUIRE(collected.windows.size() == 4);
  CHECK(collected.windows[0] == events_at({-11}));
  CHECK(collected.windows[1] == events_at({-10, -1}));
  CHECK(collected.windows[2] == events_at({0, 9}));
  CHECK(collected.windows[3] == events_at({10}));
  windows.end_by(49, collected.take());
  CHECK(collected.windows.size() == 4);
  windows.end_by(50, collected.take());
  REQUIRE(collected.windows.size() == 5);
  CHECK(collected.windows[4] == events_at({45, 49}));
  windows.end_by(std::int64_t{1} << 62, collected.take());
  CHECK(collected.windows.size() == 5);
}

TEST_CASE("windows of time end by themselves or by being asked, with the same events") {
  Collected asked;
  Collected unasked;
  EventWindows first = EventWindows::of_duration(100);
  EventWindows second = EventWindows::of_duration(100);
  for (const Event& event : test::random_events({0, 0, 4, 4}, 500, 13, 1)) {
    first.end_by(event.t_us, asked.take());
    first.add({&event, 1}, {}, asked.take());
    second.add({&event, 1}, {}, unasked.take());
  }
  CHECK(asked.windows.size() > 30);
  CHECK(asked.windows == unasked.windows);
}

TEST_CASE("an event that comes after its window was ended is not lost") {
  Collected collected;
  EventWindows windows = EventWindows::of_duration(10);
  windows.add(events_at({3}), {}, collected.take());
  windows.end_by(10, collected.take());
  windows.add(events_at({5, 12}), {}, collected.take());
  windows.end_by(20, collected.take());
  std::size_t events = 0;
  for (const auto& window : collected.windows) events += window.size();
  CHECK(events == 3);
}

TEST_CASE("windows and weights don't depend on how events are cut into calls") {
  const std::vector<Event> events = test::random_events({0, 0, 8, 8}, 3000, 10, 2);
  std::vector<float> weights;
  for (std::size_t i = 0; i < events.size(); ++i) weights.push_back(static_cast<float>(i));
  for (const auto& make :
       {+[] { return EventWindows::of_count(70); }, +[] { return EventWindows::of_duration(900); },
        +[] { return EventWindows::of_count_within(70, 720); }}) {
    Collected whole;
    EventWindows at_once = make();
    at_once.add(events, weights, whole.take());
    REQUIRE(whole.windows.size() > 20);
    float index = 0.0F;
    for (std::size_t k = 0; k < whole.windows.size(); ++k) {
      REQUIRE(whole.weights[k].size() == whole.windows[k].size());
      for (const float weight : whole.weights[k]) REQUIRE(weight == index++);
    }
    std::mt19937 random(3);
    for (const unsigned largest : {1U, 5U, 200U}) {
      Collected cut;
      EventWindows windows = make();
      for (std::size_t i = 0; i < events.size();) {
        const std::size_t count = std::min<std::size_t>(random() % largest + 1, events.size() - i);
        windows.add(std::span(events).subspan(i, count), std::span(weights).subspan(i, count), cut.take());
        windows.add({}, {}, cut.take());
        i += count;
      }
      CHECK(cut.windows == whole.windows);
      CHECK(cut.weights == whole.weights);
    }
  }
}

TEST_CASE("events without weights count 1, beside others that have some") {
  Collected collected;
  EventWindows windows = EventWindows::of_count(3);
  windows.add(events_at({0}), {}, collected.take());
  windows.add(events_at({1}), std::vector<float>{0.5F}, collected.take());
  windows.add(events_at({2}), {}, collected.take());
  REQUIRE(collected.weights.size() == 1);
  CHECK(collected.weights[0] == std::vector<float>{1.0F, 0.5F, 1.0F});
}

TEST_CASE("a window of events within a duration ends after the microsecond of its last event") {
  Collected collected;
  std::vector<Interval> times;
  EventWindows windows = EventWindows::of_count_within(3, 10'000);
  windows.add(events_at({2000, 2400, 3000, 3000, 3000, 3001, 5000}), {}, collected.take_from(windows, times));
  REQUIRE(times.size() == 1);
  CHECK(collected.windows[0] == events_at({2000, 2400, 3000, 3000, 3000}));
  CHECK(times[0] == Interval{2000, 3001});
  CHECK(windows.open_begin_us() == 3001);
  // The next begins where it ended; its third event is the last one of 6000 us.
  windows.add(events_at({6000}), {}, collected.take_from(windows, times));
  windows.end_by(6000, collected.take_from(windows, times));
  CHECK(times.size() == 1);
  windows.end_by(6001, collected.take_from(windows, times));
  REQUIRE(times.size() == 2);
  CHECK(times[1] == Interval{3001, 6001});
  CHECK(windows.open_begin_us() == std::nullopt);
}

TEST_CASE("a window of events within a duration is neither too short nor too long") {
  constexpr std::int64_t kLongest_us = 4000;
  Collected collected;
  std::vector<Interval> times;
  EventWindows windows = EventWindows::of_count_within(3, kLongest_us);
  const auto take = collected.take_from(windows, times);
  // So many in 3 us; then two within the longest duration; then none for less than that; then none for it.
  windows.add(events_at({-1, 0, 1, 2, 498, 499, 600, 4498, 4499}), {}, take);
  REQUIRE(times.size() == 2);
  CHECK(times[0] == Interval{-1, -1 + EventWindows::kShortestWindow_us});
  CHECK(collected.windows[0] == events_at({-1, 0, 1, 2, 498}));
  CHECK(times[1] == Interval{499, 499 + kLongest_us});
  CHECK(collected.windows[1] == events_at({499, 600, 4498}));
  windows.add(events_at({8498, 12'498, 12'499}), {}, take);
  REQUIRE(times.size() == 4);
  CHECK(times[2] == Interval{4499, 8499});
  CHECK(times[3] == Interval{8499, 12'499});
  windows.add(events_at({20'499}), {}, take);
  REQUIRE(times.size() == 5);
  CHECK(times[4] == Interval{12'499, 16'499});
  CHECK(windows.open_begin_us() == 20'499);
  windows.add(events_at({29'000}), {}, take);
  CHECK(times[5] == Interval{20'499, 24'499});
  // Never longer than the longest, even where that is below the shortest.
  EventWindows brief = EventWindows::of_count_within(2, 300);
  brief.add(events_at({0, 1, 300}), {}, collected.take_from(brief, times));
  CHECK(times.back() == Interval{0, 300});
}

TEST_CASE("windows end at the latest and the earliest times there are") {
  constexpr std::int64_t kEarliest_us = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLatest_us = std::numeric_limits<std::int64_t>::max();
  for (const auto& make : {+[] { return EventWindows::of_duration(700); },
                           +[] { return EventWindows::of_count_within(2, 700); }}) {
    Collected collected;
    EventWindows windows = make();
    windows.add(events_at({kEarliest_us, kEarliest_us + 1, kEarliest_us + 900, kLatest_us - 1, kLatest_us,
                           kLatest_us}),
                {}, collected.take());
    windows.end_by(kLatest_us, collected.take());
    std::size_t events = 0;
    for (const auto& window : collected.windows) events += window.size();
    CHECK(events == 6);
  }
}

TEST_CASE("windows of time have times on the clock") {
  Collected collected;
  std::vector<Interval> times;
  EventWindows windows = EventWindows::of_duration(10);
  const auto take = collected.take_from(windows, times);
  windows.add(events_at({-11, -10, 3, 47}), {}, take);
  CHECK(times == std::vector<Interval>{{-20, -10}, {-10, 0}, {0, 10}});
  CHECK(windows.open_begin_us() == 40);
}
