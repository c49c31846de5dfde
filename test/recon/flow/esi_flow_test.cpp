#include "esi/recon/flow/esi_flow.hpp"

#include <catch2/catch.hpp>

#include "recon/flow/flow_runs.hpp"
#include "support/random_events.hpp"

using namespace esi;
using namespace esi::test;

TEST_CASE("the image of a moving texture is the texture where it is now") {
  const cv::Mat1f last = frames_of({}, moving_events(), {600'000}).back();
  CHECK(correlation(last, truth(0.6), 8) > 0.9);
  CHECK(correlation(last, truth(0.6), 8) > correlation(last, truth(0.57), 8));
}

TEST_CASE("frames don't depend on how events are cut into calls, nor on other frames") {
  for (const EsiFlowOptions& options : kBothWindows) {
    const auto expected = frames_of(options, moving_events(), every(50'000, 600'000));
    for (const std::size_t largest : {std::size_t{1}, std::size_t{777}}) {
      const auto cut = frames_of(options, moving_events(), every(50'000, 600'000), largest);
      for (std::size_t k = 0; k < cut.size(); ++k) CHECK(cv::norm(cut[k], expected[k], cv::NORM_INF) == 0.0);
    }
    const auto often = frames_of(options, moving_events(), every(2'500, 600'000));
    for (std::size_t k = 0; k < expected.size(); ++k) {
      CHECK(cv::norm(often[20 * k + 19], expected[k], cv::NORM_INF) == 0.0);
    }
    const auto twice = frames_of(options, moving_events(), {303'000, 303'000});
    CHECK(cv::norm(twice[0], twice[1], cv::NORM_INF) == 0.0);
  }
}

TEST_CASE("a frame within a window is moved on by the motion so far") {
  const auto frames = frames_of({}, moving_events(), {540'000, 547'500});
  CHECK(correlation(frames[1], truth(0.5475), 8) > correlation(frames[0], truth(0.5475), 8) + 0.005);
  CHECK(correlation(frames[1], truth(0.5475), 8) > 0.9);
}

TEST_CASE("a part that has begun as a negative becomes right") {
  const auto slow = [](int x, int y, double t_s) { return 0.5 * kWaves.at(x - 35.0 * t_s, y - 15.0 * t_s); };
  std::vector<Event> events = events_of(kSize, 0, 400'000, 0.15, slow);
  // For so long ON and OFF are exchanged: a negative that moves as the scene does.
  for (Event& event : events) event.on = event.on != (event.t_us < 150'000);
  const auto frames = frames_of({}, events, {150'000, 400'000});
  const auto at = [&](double t_s) {
    return image_of({kSize.width_px, kSize.height_px}, [&](int x, int y) { return slow(x, y, t_s); });
  };
  CHECK(correlation(frames[0], at(0.15), 8) < -0.5);
  CHECK(correlation(frames[1], at(0.4), 8) > 0.5);
}

TEST_CASE("windows of another length give much the same image") {
  for (const std::int64_t window_us : {5'000, 20'000}) {
    EsiFlowOptions options;
    options.window_us = window_us;
    INFO(window_us);
    CHECK(correlation(frames_of(options, moving_events(), {600'000}).back(), truth(0.6), 8) > 0.88);
  }
}

TEST_CASE("a still camera keeps its image through a pause of 2 s with noise") {
  constexpr double kStop_s = 0.6;
  std::vector<Event> events = moving_events();
  // 1 Hz of noise a pixel: an event every 130 us.
  std::vector<Event> noise = random_events({0, 0, kSize.width_px, kSize.height_px}, 15'384, 130, 5);
  for (Event& event : noise) event.t_us += 600'000;
  events.insert(events.end(), noise.begin(), noise.end());
  REQUIRE(events.back().t_us > 2'550'000);
  for (const EsiFlowOptions& options : kBothWindows) {
    const auto frames = frames_of(options, events, {600'000, 2'600'000});
    const double before = correlation(frames[0], truth(kStop_s, kStop_s), 8);
    const double after = correlation(frames[1], truth(kStop_s, kStop_s), 8);
    INFO(before << " " << after);
    CHECK(before > 0.9);
    CHECK(after > before - 0.03);
  }
}

TEST_CASE("where nothing happens, time doesn't pass") {
  const std::vector<std::int64_t> times_us{600'000, 610'000, 615'000, 2'004'000, std::int64_t{1} << 60};
  for (const EsiFlowOptions& options : kBothWindows) {
    const auto frames = frames_of(options, moving_events(), times_us);
    // The window that is open at the events' end goes on for 10 ms at most.
    for (std::size_t k = 2; k < frames.size(); ++k) {
      CHECK(cv::norm(frames[k], frames[1], cv::NORM_INF) == 0.0);
    }
  }
  CHECK(cv::norm(frames_of({}, moving_events(), times_us)[0], frames_of({}, moving_events(), times_us)[1],
                 cv::NORM_INF) == 0.0);
}

TEST_CASE("after windows without events motion begins from zero") {
  for (const EsiFlowOptions& options : kBothWindows) {
    EsiFlow flow(options, kSize);
    std::size_t given = 0;
    flow.process(events_until(moving_events(), given, 500'000));
    levels_at(flow, 510'000);
    CHECK(cv::norm(cv::mean(*flow.motion())) > 40.0);
    flow.process(std::vector<Event>{{525'000, 3, 3, true}});
    levels_at(flow, 540'000);
    CHECK(cv::norm(cv::mean(*flow.motion())) < 10.0);
  }
}

TEST_CASE("the motion that is shown is that of the scene, in px per second") {
  EsiFlow flow({}, kSize);
  CHECK(flow.motion() != nullptr);
  std::size_t given = 0;
  flow.process(events_until(moving_events(), given, 500'000));
  levels_at(flow, 500'000);
  const cv::Mat2f& motion = *flow.motion();
  const cv::Point2d expected = (place_at(0.5, 1e9) - place_at(0.49, 1e9)) / 0.01;
  const cv::Scalar mean = cv::mean(motion(cv::Rect(16, 16, 64, 48)));
  INFO(mean << " " << expected);
  CHECK(mean[0] == Approx(expected.x).margin(8.0));
  CHECK(mean[1] == Approx(expected.y).margin(8.0));
}

TEST_CASE("the motion is little faster than the scene's") {
  EsiFlow flow({}, kSize);
  std::size_t given = 0;
  double along = 0.0;
  double expected = 0.0;
  for (std::int64_t t_us = 300'000; t_us <= 600'000; t_us += 10'000) {
    flow.process(events_until(moving_events(), given, t_us));
    levels_at(flow, t_us);
    const double t_s = 1e-6 * static_cast<double>(t_us);
    const cv::Point2d v = (place_at(t_s, 1e9) - place_at(t_s - 0.01, 1e9)) / 0.01;
    const cv::Scalar mean = cv::mean((*flow.motion())(cv::Rect(16, 16, 64, 48)));
    along += mean[0] * v.x + mean[1] * v.y;
    expected += v.dot(v);
  }
  // Known to be 6 % too fast; by L alone it would be 11.
  CHECK(along / expected == Approx(1.0).margin(0.08));
}
