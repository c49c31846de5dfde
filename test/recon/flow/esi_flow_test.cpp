#include "esi/recon/flow/esi_flow.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "recon/flow/textures.hpp"
#include "support/random_events.hpp"

using namespace esi;
using namespace esi::test;

namespace {

constexpr SensorSize kSize{96, 80};
constexpr std::int64_t kWindow_us = 10'000;
const Waves kWaves(11, 8.0, 60.0);

/// The camera moves along a circle until `stop_us`, then stands still.
cv::Point2d place_at(double t_s, double stop_s) {
  const double turn = 4.0 * std::min(t_s, stop_s);
  return {20.0 * std::sin(turn), 20.0 * std::cos(turn)};
}

double scene(int x, int y, double t_s, double stop_s = 1e9) {
  return 0.5 * kWaves.at(cv::Point2d(x, y) - place_at(t_s, stop_s));
}

const std::vector<Event>& moving_events() {
  static const std::vector<Event> events =
      events_of(kSize, 0, 600'000, 0.15, [](int x, int y, double t_s) { return scene(x, y, t_s); });
  return events;
}

cv::Mat1f truth(double t_s, double stop_s = 1e9) {
  return image_of({kSize.width_px, kSize.height_px}, [&](int x, int y) { return scene(x, y, t_s, stop_s); });
}

/// Those with t < t_us, from `given` on, which is moved on.
std::span<const Event> events_until(const std::vector<Event>& events, std::size_t& given, std::int64_t t_us) {
  const auto begin = events.begin() + static_cast<std::ptrdiff_t>(given);
  const auto end =
      std::partition_point(begin, events.end(), [t_us](const Event& e) { return e.t_us < t_us; });
  const std::span<const Event> due(begin, end);
  given += due.size();
  return due;
}

cv::Mat1f levels_at(EsiFlow& flow, std::int64_t t_us) {
  cv::Mat1f levels;
  flow.render_levels(t_us, levels);
  return levels;
}

/// Frames at the times, in order; the events of each come in calls of at most `largest`.
std::vector<cv::Mat1f> frames_of(const EsiFlowOptions& options, const std::vector<Event>& events,
                                 const std::vector<std::int64_t>& times_us, std::size_t largest = 1'000'000) {
  EsiFlow flow(options, kSize);
  std::size_t given = 0;
  std::vector<cv::Mat1f> frames;
  for (const std::int64_t t_us : times_us) {
    for (auto due = events_until(events, given, t_us); !due.empty();
         due = due.subspan(std::min(largest, due.size()))) {
      flow.process(due.first(std::min(largest, due.size())));
    }
    frames.push_back(levels_at(flow, t_us));
  }
  return frames;
}

std::vector<std::int64_t> every(std::int64_t period_us, std::int64_t end_us) {
  std::vector<std::int64_t> times_us;
  for (std::int64_t t_us = period_us; t_us <= end_us; t_us += period_us) times_us.push_back(t_us);
  return times_us;
}

}  // namespace

TEST_CASE("the image of a moving texture is the texture where it is now") {
  const cv::Mat1f last = frames_of({}, moving_events(), {600'000}).back();
  CHECK(correlation(last, truth(0.6), 8) > 0.9);
  CHECK(correlation(last, truth(0.6), 8) > correlation(last, truth(0.57), 8));
}

TEST_CASE("frames don't depend on how events are cut into calls, nor on other frames") {
  const auto expected = frames_of({}, moving_events(), every(50'000, 600'000));
  for (const std::size_t largest : {std::size_t{1}, std::size_t{777}}) {
    const auto cut = frames_of({}, moving_events(), every(50'000, 600'000), largest);
    for (std::size_t k = 0; k < cut.size(); ++k) CHECK(cv::norm(cut[k], expected[k], cv::NORM_INF) == 0.0);
  }
  const auto often = frames_of({}, moving_events(), every(2'500, 600'000));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CHECK(cv::norm(often[20 * k + 19], expected[k], cv::NORM_INF) == 0.0);
  }
  const auto twice = frames_of({}, moving_events(), {303'000, 303'000});
  CHECK(cv::norm(twice[0], twice[1], cv::NORM_INF) == 0.0);
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
  const auto frames = frames_of({}, events, {600'000, 2'600'000});
  const double before = correlation(frames[0], truth(kStop_s, kStop_s), 8);
  const double after = correlation(frames[1], truth(kStop_s, kStop_s), 8);
  INFO(before << " " << after);
  CHECK(after > before - 0.03);
}

TEST_CASE("where nothing happens, time doesn't pass") {
  const auto expected = frames_of({}, moving_events(), {600'000});
  const auto later = frames_of({}, moving_events(), {600'000, 605'000, 2'004'000, std::int64_t{1} << 60});
  for (const cv::Mat1f& frame : later) CHECK(cv::norm(frame, expected[0], cv::NORM_INF) == 0.0);
}

TEST_CASE("after windows without events motion begins from zero") {
  EsiFlow flow({}, kSize);
  std::size_t given = 0;
  flow.process(events_until(moving_events(), given, 500'000));
  levels_at(flow, 500'000);
  CHECK(cv::norm(cv::mean(*flow.motion())) > 40.0);
  flow.process(std::vector<Event>{{520'000, 3, 3, true}});
  levels_at(flow, 530'000);
  CHECK(cv::norm(cv::mean(*flow.motion())) < 10.0);
}

TEST_CASE("a window counts by its share of 10 ms") {
  EsiFlowOptions options;
  options.memory = 0.81;
  options.window_us = 5000;
  CHECK(options.model().weight == 2.0F);
  CHECK(options.model().memory == Approx(0.9));
  CHECK(options.model().eps == static_cast<float>(options.eps));
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
  for (std::int64_t t_us = 300'000; t_us <= 600'000; t_us += kWindow_us) {
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
