// What --info --check counts: rates, pauses, hot pixels.
#include <catch2/catch.hpp>
#include <random>

#include "esi/io/check/event_rate.hpp"
#include "esi/io/check/gaps.hpp"
#include "esi/io/check/pixel_counts.hpp"

using namespace esi;

namespace {

std::vector<Event> events_at(const std::vector<std::int64_t>& times_us) {
  std::vector<Event> events;
  events.reserve(times_us.size());
  for (const std::int64_t t_us : times_us) events.push_back({t_us, 1, 1, true});
  return events;
}

}  // namespace

TEST_CASE("rates are counted in equal bins from the first event on") {
  EventRate rate;
  rate.add(events_at({500, 1499, 1500}));
  rate.add(events_at({4500, 4501}));
  CHECK(rate.bin_us() == 1000);
  CHECK(std::vector(rate.bins().begin(), rate.bins().end()) == std::vector<std::int64_t>{2, 1, 0, 0, 2});
}

TEST_CASE("bins widen with the recording, and no event is lost") {
  std::mt19937 random(3);
  EventRate rate;
  std::vector<Event> all;
  for (std::int64_t t_us = 77; all.size() < 20000; t_us += static_cast<std::int64_t>(random() % 1000)) {
    all.push_back({t_us, 0, 0, true});
    rate.add({&all.back(), 1});
  }
  CHECK(rate.bins().size() <= EventRate::kMaxBins);
  CHECK(rate.bins().size() > EventRate::kMaxBins / 2);
  std::vector<std::int64_t> expected(rate.bins().size());
  for (const Event& event : all) ++expected.at(static_cast<std::size_t>((event.t_us - 77) / rate.bin_us()));
  CHECK(std::vector(rate.bins().begin(), rate.bins().end()) == expected);
}

TEST_CASE("a pause of a year costs no time") {
  EventRate rate;
  rate.add(events_at({0, 31557600000000}));
  CHECK(rate.bins().size() <= EventRate::kMaxBins);
  CHECK(rate.bins().back() == 1);
}

TEST_CASE("the longest pauses are kept in order of time, across packets") {
  Gaps gaps;
  gaps.add(events_at({10, 20, 1020}));
  gaps.add(events_at({1021, 3021}));
  gaps.add(events_at({3521}));
  CHECK(gaps.longer_than(999) == std::vector<Interval>{{20, 1020}, {1021, 3021}});
  CHECK(gaps.longer_than(1000) == std::vector<Interval>{{1021, 3021}});

  Gaps many;
  std::vector<std::int64_t> times_us{0};
  for (std::int64_t i = 1; i <= 100; ++i) times_us.push_back(times_us.back() + i * 7 % 101);
  many.add(events_at(times_us));
  const auto kept = many.longer_than(0);
  REQUIRE(kept.size() == Gaps::kMost);
  for (const Interval& gap : kept) CHECK(gap.duration_us() > 100 - static_cast<std::int64_t>(Gaps::kMost));
}

TEST_CASE("a pixel far busier than its neighbours is hot, an edge is not") {
  std::mt19937 random(5);
  std::vector<Event> events;
  std::int64_t t_us = 0;
  const auto fire = [&](int x, int y, int times) {
    for (int i = 0; i < times; ++i) {
      events.push_back({++t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), true});
    }
  };
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) fire(x, y, static_cast<int>(random() % 4));
    fire(30, y, 300);  // a bright edge: each of its pixels has two such neighbours above and below
    fire(31, y, 300);
    fire(32, y, 300);
  }
  fire(5, 5, 400);
  fire(59, 39, 100);  // in the corner
  fire(0, 20, 16);    // too few to tell
  PixelCounts counts;
  for (std::size_t begin = 0; begin < events.size(); begin += 1000) {
    counts.add(std::span(events).subspan(begin, std::min<std::size_t>(1000, events.size() - begin)));
  }
  const auto hot = counts.hot_pixels();
  REQUIRE(hot.size() == 2);
  CHECK((hot[0].x == 5 && hot[0].y == 5 && hot[0].events >= 400));
  CHECK((hot[1].x == 59 && hot[1].y == 39));
}

TEST_CASE("counting pixels gives up before it takes absurd memory") {
  PixelCounts counts;
  const std::vector<Event> events = {{0, 3, 4, true}, {1, 65535, 65535, true}, {2, 3, 4, true}};
  counts.add(events);
  CHECK(counts.gave_up());
  CHECK(counts.hot_pixels().empty());
}
