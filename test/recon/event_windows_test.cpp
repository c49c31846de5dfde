#include "esi/recon/event_windows.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "support/random_events.hpp"

using namespace esi;

namespace {

/// All windows that were handed on.
struct Collected {
  std::vector<std::vector<Event>> windows;
  std::vector<std::vector<float>> weights;

  EventWindows::Take take() {
    return [this](std::span<const Event> events, std::span<const float> given) {
      windows.emplace_back(events.begin(), events.end());
      weights.emplace_back(given.begin(), given.end());
    };
  }
};

std::vector<Event> events_at(const std::vector<std::int64_t>& times_us) {
  std::vector<Event> events;
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
       {+[] { return EventWindows::of_count(70); }, +[] { return EventWindows::of_duration(900); }}) {
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
