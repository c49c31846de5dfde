// Windows of esi-flow that end after so many events, or last for another time than 10 ms.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "recon/flow/flow_runs.hpp"
#include "support/random_events.hpp"

using namespace esi;
using namespace esi::test;

namespace {

/// What a texture was moved by at t_s: at first slowly, from 0.3 s on ten times as fast.
double path_px(double t_s) { return 150.0 * std::min(t_s, 0.3) + 1500.0 * std::max(t_s - 0.3, 0.0); }

double accelerated_scene(int x, int y, double t_s) {
  const double path = path_px(t_s);
  return 0.5 * kWaves.at(x - 0.8 * path, y - 0.6 * path);
}

}  // namespace

TEST_CASE("windows of events get shorter where the image moves faster") {
  const auto events = events_of(kSize, 0, 400'000, 0.15, accelerated_scene, 250);
  const auto error_at = [&](const EsiFlowOptions& options, double t_s) {
    const cv::Mat1f now = image_of({kSize.width_px, kSize.height_px},
                                   [t_s](int x, int y) { return accelerated_scene(x, y, t_s); });
    const auto frames = frames_of(options, events, {static_cast<std::int64_t>(1e6 * t_s)});
    return 1.0 - correlation(frames.back(), now, 8);
  };
  const EsiFlowOptions of_events = by_events(0.5);
  CHECK(error_at(of_events, 0.3) < 0.06);
  CHECK(error_at(of_events, 0.4) < 0.06);
  for (const std::int64_t window_us : {1000, 2000, 5000, 10'000}) {
    EsiFlowOptions of_time;
    of_time.window_us = window_us;
    INFO(window_us);
    CHECK(error_at(of_time, 0.3) + error_at(of_time, 0.4) >
          1.2 * (error_at(of_events, 0.3) + error_at(of_events, 0.4)));
  }
}

TEST_CASE("frames within windows of events are moved on, too") {
  // Windows last for about 8 ms: without, the image would be up to 0.6 px behind.
  double least = 1.0;
  EsiFlow flow(by_events(0.4), kSize);
  std::size_t given = 0;
  for (const std::int64_t t_us : every(1000, 600'000)) {
    flow.process(events_until(moving_events(), given, t_us));
    if (t_us < 400'000) continue;
    const double t_s = 1e-6 * static_cast<double>(t_us);
    least = std::min(least, correlation(levels_at(flow, t_us), truth(t_s), 8));
  }
  CHECK(least > 0.96);
}

TEST_CASE("the motion goes on from a window of events to one that has not as many") {
  // The image moves fast and slowly by turns. Fast, windows have all their events; slowly, they last for 10
  // ms and have from all of them down to a tenth.
  const auto path_px = [](double t_s) { return 500.0 * t_s + 14.0 * std::sin(30.0 * t_s); };
  const auto moved = [&](int x, int y, double t_s) {
    return 0.5 * kWaves.at(x - 0.8 * path_px(t_s), y - 0.6 * path_px(t_s));
  };
  const auto events = events_of(kSize, 0, 600'000, 0.15, moved, 500);
  EsiFlow flow(by_events(2.0), kSize);
  std::size_t given = 0;
  double squares = 0.0;
  double squares_of_truth = 0.0;
  for (const std::int64_t t_us : every(10'000, 600'000)) {
    flow.process(events_until(events, given, t_us));
    levels_at(flow, t_us);
    const double t_s = 1e-6 * static_cast<double>(t_us);
    const double speed_px_s = (path_px(t_s) - path_px(t_s - 0.01)) / 0.01;
    const cv::Scalar shown = cv::mean((*flow.motion())(cv::Rect(16, 16, 64, 48)));
    const double along = 0.8 * shown[0] + 0.6 * shown[1];
    if (t_us < 200'000) continue;
    squares += (along - speed_px_s) * (along - speed_px_s);
    squares_of_truth += speed_px_s * speed_px_s;
  }
  CHECK(std::sqrt(squares / squares_of_truth) < 0.07);
}

namespace {

/// Four times as fast from 0.3 s on.
double stepped_scene(int x, int y, double t_s) {
  return 0.5 * kWaves.at(x - 100.0 * t_s - 300.0 * std::max(t_s - 0.3, 0.0), y);
}

const std::vector<Event>& stepped_events() {
  static const std::vector<Event> events = events_of(kSize, 0, 320'000, 0.15, stepped_scene, 500);
  return events;
}

}  // namespace

TEST_CASE("a window of four times as many events has four times the motion") {
  EsiFlow flow(by_events(20.0), kSize);
  std::size_t given = 0;
  for (const std::int64_t t_us : every(10'000, 320'000)) {
    flow.process(events_until(stepped_events(), given, t_us));
    levels_at(flow, t_us);
  }
  CHECK(cv::mean((*flow.motion())(cv::Rect(16, 16, 64, 48)))[0] == Approx(400.0).epsilon(0.05));
}

TEST_CASE("a frame is moved on by the open window's events, not by its time") {
  EsiFlow flow(by_events(0.5), kSize);
  std::size_t given = 0;
  for (const std::int64_t t_us : every(500, 310'000)) {
    flow.process(events_until(stepped_events(), given, t_us));
    const double t_s = 1e-6 * static_cast<double>(t_us);
    const cv::Mat1f now =
        image_of({kSize.width_px, kSize.height_px}, [t_s](int x, int y) { return stepped_scene(x, y, t_s); });
    const double found = correlation(levels_at(flow, t_us), now, 8);
    INFO(t_us);
    if (t_us > 300'000) CHECK(found > 0.93);
  }
}

namespace {

constexpr double kPan_px_s = 600.0;

/// The camera pans until 0.3 s, waits, and pans back from 0.4 s on.
double pan_px(double t_s) { return kPan_px_s * (std::min(t_s, 0.3) - std::max(t_s - 0.4, 0.0)); }

double panned_scene(int x, int y, double t_s) {
  return 0.5 * kWaves.at(x - pan_px(t_s), y - 0.3 * pan_px(t_s));
}

std::vector<Event> events_of_pan_and_back() {
  std::vector<Event> events = events_of(kSize, 0, 300'000, 0.15, panned_scene, 250);
  const std::vector<Event> back = events_of(kSize, 400'000, 460'000, 0.15, panned_scene, 250);
  events.insert(events.end(), back.begin(), back.end());
  return events;
}

}  // namespace

TEST_CASE("after a pause nothing is left of the motion before it") {
  const auto events = events_of_pan_and_back();
  // Both have windows of 6 px of motion and more, which is too far off to be found from the opposite motion.
  for (const EsiFlowOptions& options : {EsiFlowOptions{}, by_events(3.0)}) {
    const auto frames = frames_of(options, events, {420'000, 430'000, 460'000});
    const auto found = [&](std::size_t k, double t_s) {
      return correlation(frames[k],
                         image_of({kSize.width_px, kSize.height_px},
                                  [t_s](int x, int y) { return panned_scene(x, y, t_s); }),
                         8);
    };
    CHECK(found(0, 0.42) > 0.79);
    CHECK(found(1, 0.43) > 0.83);
    CHECK(found(2, 0.46) > 0.88);
  }
}

TEST_CASE("a pause among the first windows ends their motion, too") {
  std::vector<Event> events = moving_events();
  std::erase_if(events, [](const Event& event) { return event.t_us >= 40'000 && event.t_us < 300'000; });
  EsiFlow flow({}, kSize);
  std::size_t given = 0;
  flow.process(events_until(events, given, 40'000));
  levels_at(flow, 40'000);
  CHECK(cv::norm(*flow.motion(), cv::NORM_INF) > 10.0);
  flow.process(events_until(events, given, 310'000));
  levels_at(flow, 310'000);
  CHECK(cv::norm(*flow.motion(), cv::NORM_INF) == 0.0);
}

TEST_CASE("a few events after a pause don't move the image") {
  std::vector<Event> events = events_of_pan_and_back();
  std::erase_if(events, [](const Event& event) { return event.t_us >= 400'000; });
  for (int k = 0; k < 20; ++k) {
    events.push_back({400'000 + 1000 * k, static_cast<std::uint16_t>(30 + k), 40, k % 2 == 0});
  }
  const auto frames = frames_of({}, events, {390'000, 410'000, 420'000});
  CHECK(correlation(frames[1], frames[0], 8) > 0.999);
  CHECK(correlation(frames[2], frames[0], 8) > 0.999);
}

TEST_CASE("the past is forgotten by time where nothing moves, however long windows are") {
  // A still scene in which an event happens every millisecond: A fades, and eps blurs what it held.
  std::vector<Event> events = moving_events();
  for (Event event : random_events({0, 0, kSize.width_px, kSize.height_px}, 300, 1000, 5)) {
    event.t_us += 600'000;
    events.push_back(event);
  }
  std::vector<EsiFlowOptions> all;
  for (const std::int64_t window_us : {2'500, 5'000, 10'000, 20'000})
    all.emplace_back().window_us = window_us;
  for (const std::int64_t longest_us : {3'000, 40'000}) {
    all.push_back(by_events(0.3));
    all.back().window_us = longest_us;
  }
  for (EsiFlowOptions options : all) {
    options.memory = 0.93;
    options.memory_px = 8.0;
    options.eps = 0.03;
    options.cycles = 4;
    const auto frames = frames_of(options, events, {600'000, 900'000});
    const double kept = correlation(frames[1], frames[0], 8);
    INFO(options.window_us << " us");
    CHECK(kept > 0.9);
    CHECK(kept < 0.98);
  }
}
