// Every method of the table with all steps around it.

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "contract/methods_under_test.hpp"
#include "esi/recon/steps/stepped_reconstructor.hpp"
#include "support/random_events.hpp"

using namespace esi;

namespace {

constexpr SensorSize kSize{40, 32};
constexpr std::int64_t kPeriod_us = 50'000;

StepOptions all_steps() {
  StepOptions options;
  options.filters.background_us = 3000;
  options.filters.refractory_us = 5000;
  options.balance.balance = true;
  options.smoothing = {.median = true, .blur_px = 0.7};
  options.range.range = Range::percentile;
  return options;
}

StepSurroundings surroundings() {
  return {kSize, {}, {{12, 9}, {20, 20}}, CameraCalibration{kSize, 40.0, 40.0, 19.0, 16.0, {}, {-0.1, 0.01}}};
}

struct Run {
  RemovedEvents removed;
  std::vector<cv::Mat1b> frames;
};

/// Frames every 50 ms, the events given in calls of at most `largest` each.
Run run(const Method& method, std::vector<Event> events, std::int64_t shift_us, unsigned largest) {
  Run run;
  const auto reconstructor =
      with_steps(test::created(*test::configured(method), kSize), all_steps(), surroundings(), run.removed);
  for (Event& event : events) event.t_us += shift_us;
  std::mt19937 random(2);
  std::span<const Event> left = events;
  while (!left.empty()) {
    const std::int64_t t_us = shift_us + static_cast<std::int64_t>(run.frames.size() + 1) * kPeriod_us;
    while (!left.empty() && left.front().t_us < t_us) {
      std::size_t count = 0;
      const std::size_t most = 1 + random() % largest;
      while (count < std::min(most, left.size()) && left[count].t_us < t_us) ++count;
      reconstructor->process(left.first(count));
      left = left.subspan(count);
    }
    reconstructor->render(t_us, run.frames.emplace_back());
  }
  return run;
}

void require_equal(const Run& a, const Run& b) {
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t k = 0; k < a.frames.size(); ++k) {
    REQUIRE(cv::norm(a.frames[k], b.frames[k], cv::NORM_INF) == 0);
  }
  CHECK(a.removed.hot_pixels == b.removed.hot_pixels);
  CHECK(a.removed.refractory == b.removed.refractory);
  CHECK(a.removed.background == b.removed.background);
}

}  // namespace

TEST_CASE("with all steps, frames and counts don't depend on how events are cut into calls") {
  const auto events = test::random_events({8, 8, 24, 16}, 20000, 20, 1);
  for (const Method& method : methods()) {
    INFO(method.name);
    const Run expected = run(method, events, 0, 1'000'000);
    CHECK(expected.frames.size() > 5);
    CHECK(expected.removed.hot_pixels > 50);
    CHECK(expected.removed.refractory > 500);
    CHECK(expected.removed.background > 500);
    for (const unsigned largest : {1U, 3U, 500U, 6000U}) {
      require_equal(run(method, events, 0, largest), expected);
    }
  }
}

TEST_CASE("with all steps, a shift in time shifts the frames") {
  const auto events = test::random_events({8, 8, 24, 16}, 20000, 20, 2);
  for (const Method& method : methods()) {
    INFO(method.name);
    const Run expected = run(method, events, 0, 8192);
    for (const std::int64_t shift_us : {std::int64_t{-7'000'000}, std::int64_t{1'700'000'000'000'000}}) {
      require_equal(run(method, events, shift_us, 8192), expected);
    }
  }
}

TEST_CASE("with all steps, a recording without events gives the same image whenever") {
  for (const Method& method : methods()) {
    INFO(method.name);
    RemovedEvents removed;
    const auto reconstructor =
        with_steps(test::created(*test::configured(method), kSize), all_steps(), surroundings(), removed);
    cv::Mat1b first, later;
    reconstructor->process({});
    reconstructor->render(0, first);
    reconstructor->render(std::int64_t{1} << 50, later);
    CHECK(first.size() == cv::Size(kSize.width_px, kSize.height_px));
    CHECK(cv::norm(first, later, cv::NORM_INF) == 0);
  }
}

// An undistorted image is black where the sensor didn't look, so that it has no mirror image.
TEST_CASE("with all other steps, swapping all polarities mirrors the image of esi about neutral") {
  const auto levels_of = [](const std::vector<Event>& events) {
    RemovedEvents removed;
    const StepSurroundings around{kSize, {}, {{12, 9}, {20, 20}}, {}};
    const auto reconstructor =
        with_steps(method_named("esi").configure()->create(kSize), all_steps(), around, removed);
    reconstructor->process(events);
    cv::Mat1f levels;
    reconstructor->render_levels(events.back().t_us + 1, levels);
    return levels;
  };
  std::vector<Event> events = test::random_events({8, 8, 24, 16}, 20000, 20, 3);
  const cv::Mat1f image = levels_of(events);
  for (Event& event : events) event.on = !event.on;
  const cv::Mat1f mirrored = levels_of(events);
  CHECK(cv::norm(image, mirrored, cv::NORM_INF) > 50.0);
  CHECK(cv::norm(image + mirrored, cv::Mat1f(image.size(), 255.0F), cv::NORM_INF) <= 1.0);
}
