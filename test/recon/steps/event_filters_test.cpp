#include "esi/recon/steps/event_filters.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <limits>

#include "esi/core/error.hpp"
#include "support/random_events.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kSize{9, 7};
__extension__ using Wide = __int128;

template <class Filter>
std::vector<bool> kept(Filter filter, const std::vector<Event>& events) {
  std::vector<bool> keep;
  for (const Event& event : events) keep.push_back(filter.keep(event));
  return keep;
}

/// Looks through the whole past for a neighbour that fired lately enough.
std::vector<bool> reference_background(const std::vector<Event>& events, std::int64_t within_us) {
  std::vector<bool> keep;
  for (std::size_t i = 0; i < events.size(); ++i) {
    bool found = false;
    for (std::size_t j = 0; j < i; ++j) {
      const int dx = std::abs(events[i].x - events[j].x);
      const int dy = std::abs(events[i].y - events[j].y);
      found |= std::max(dx, dy) == 1 && Wide{events[i].t_us} - Wide{events[j].t_us} <= within_us;
    }
    keep.push_back(found);
  }
  return keep;
}

std::vector<bool> reference_refractory(const std::vector<Event>& events, std::int64_t period_us) {
  std::vector<bool> keep;
  for (std::size_t i = 0; i < events.size(); ++i) {
    bool found = false;
    for (std::size_t j = 0; j < i; ++j) {
      const bool same = events[i].x == events[j].x && events[i].y == events[j].y;
      found |= same && keep[j] && Wide{events[i].t_us} - Wide{events[j].t_us} < period_us;
    }
    keep.push_back(!found);
  }
  return keep;
}

std::vector<Event> shifted(std::vector<Event> events, std::int64_t by_us) {
  for (Event& event : events) event.t_us += by_us;
  return events;
}

/// Bursts, pauses up to hours, and the ends of what an int64 can say.
std::vector<std::vector<Event>> streams() {
  std::vector<std::vector<Event>> all;
  for (const int gap_us : {1, 30, 700}) all.push_back(test::random_events({0, 0, 9, 7}, 1500, gap_us, 3));
  all.push_back(shifted(all[1], std::numeric_limits<std::int64_t>::min()));
  all.push_back(shifted(all[1], std::numeric_limits<std::int64_t>::max() - all[1].back().t_us));
  std::vector<Event> resting;
  for (const std::int64_t begin_us :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{-9}, std::int64_t{1} << 30,
        std::int64_t{1} << 31, std::int64_t{1} << 32, (std::int64_t{1} << 32) + 999'000'000,
        std::int64_t{1} << 62, std::numeric_limits<std::int64_t>::max() - 100'000}) {
    for (const Event& event : shifted(test::random_events({0, 0, 9, 7}, 150, 40, 4), begin_us)) {
      if (resting.empty() || event.t_us >= resting.back().t_us) resting.push_back(event);
    }
  }
  all.push_back(resting);
  return all;
}

}  // namespace

TEST_CASE("the background filter keeps what a neighbour fired shortly before") {
  struct Row {
    Event before;
    Event event;
    bool keep;
  };
  const auto row = GENERATE(Row{{0, 4, 4, true}, {100, 5, 5, false}, true},
                            Row{{0, 4, 4, true}, {101, 5, 5, false}, false},
                            Row{{0, 4, 4, true}, {1, 4, 4, true}, false},   // itself is no neighbour
                            Row{{0, 4, 4, true}, {1, 6, 4, true}, false},   // two away
                            Row{{0, 4, 4, true}, {1, 4, 6, true}, false},   // two away
                            Row{{0, 4, 4, true}, {0, 3, 4, true}, true},    // at the same time
                            Row{{0, 8, 3, true}, {1, 0, 4, true}, false});  // rows don't join at their ends
  const auto keep = kept(BackgroundFilter(100, kSize), {row.before, row.event});
  CHECK_FALSE(keep[0]);
  CHECK(keep[1] == row.keep);
}

TEST_CASE("each of the 8 neighbours supports, at the border too") {
  for (const auto& [x, y] : {std::pair(4, 3), std::pair(0, 0), std::pair(8, 6)}) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!kSize.contains(x + dx, y + dy)) continue;
        const Event before{0, static_cast<std::uint16_t>(x + dx), static_cast<std::uint16_t>(y + dy), true};
        const Event event{9, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), true};
        CHECK(kept(BackgroundFilter(10, kSize), {before, event})[1] == (dx != 0 || dy != 0));
      }
    }
  }
}

TEST_CASE("the refractory filter counts from the last kept event") {
  const std::vector<Event> events{{0, 1, 1, true},   {60, 1, 1, false}, {99, 1, 1, true},  {100, 1, 1, true},
                                  {150, 1, 1, true}, {150, 2, 1, true}, {200, 1, 1, false}};
  CHECK(kept(RefractoryFilter(100, kSize), events) ==
        std::vector<bool>{true, false, false, true, false, true, true});
}

TEST_CASE("filters agree with references that look through the whole past, at any time") {
  const std::int64_t span_us = GENERATE(1, 50, 4000, 10'000'000);
  for (const auto& events : streams()) {
    CHECK(kept(BackgroundFilter(span_us, kSize), events) == reference_background(events, span_us));
    CHECK(kept(RefractoryFilter(span_us, kSize), events) == reference_refractory(events, span_us));
  }
}

TEST_CASE("hot pixels are left out, and their list is read as it is printed") {
  const auto hot = parse_pixels(" 2,3  8,6 ");
  REQUIRE(hot == std::vector<cv::Point>{{2, 3}, {8, 6}});
  const std::vector<Event> events{{0, 2, 3, true}, {1, 3, 2, true}, {2, 8, 6, true}, {3, 8, 5, true}};
  CHECK(kept(HotPixelFilter(hot, kSize), events) == std::vector<bool>{false, true, false, true});
  CHECK(parse_pixels("").empty());
  const auto bad = GENERATE("1", "1,", "1,2,3", "a,b", "1;2", "-1,2", "1, 2", "1,99999", "1,2 x");
  CHECK_THROWS_WITH(parse_pixels(bad), Contains("12,40 13,41") && Contains(bad));
  CHECK_THROWS_WITH(HotPixelFilter(std::vector<cv::Point>{{9, 0}}, kSize),
                    Contains("9,0") && Contains("9x7"));
}

TEST_CASE("options of filters are checked when they are set") {
  EventFilterOptions options;
  OptionTable table = table_of(options);
  table.at("hot_pixels").set_text("learn");
  CHECK(options.learns_hot_pixels());
  CHECK_THROWS_WITH(table.at("hot_pixels").set_text("lern"), Contains("lern"));
  CHECK_THROWS_AS(table.at("background_us").set_text("-1"), Error);
}

TEST_CASE("removing keeps each event's own weight") {
  HotPixelFilter filter(std::vector<cv::Point>{{0, 0}}, kSize);
  std::vector<Event> events{{0, 1, 0, true}, {1, 0, 0, true}, {2, 2, 0, true}, {3, 0, 0, true}};
  std::vector<float> weights{1, 2, 3, 4};
  CHECK(remove_unkept(filter, events, weights) == 2);
  CHECK(events == std::vector<Event>{{0, 1, 0, true}, {2, 2, 0, true}});
  CHECK(weights == std::vector<float>{1, 3});
}
