// What every method of the table promises about when and where events come, whatever it does inside.

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>
#include <random>

#include "contract/method_player.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

TEST_CASE("frames don't depend on how the events are cut into calls") {
  const std::vector<Event> events = scene(1);
  for_each_variant([&](const MethodConfig& config) {
    const auto expected = frames_of(config, events);
    REQUIRE(expected.size() > 5);
    std::mt19937 random(2);
    for (const unsigned largest : {1U, 3U, 500U}) {
      const auto cut = created(config, kSize);
      const auto frames = frames_of(
          *cut, events, 0, [&] { return std::size_t{1} + static_cast<std::size_t>(random() % largest); });
      REQUIRE(frames.size() == expected.size());
      for (std::size_t k = 0; k < frames.size(); ++k) REQUIRE(are_equal(frames[k], expected[k]));
    }
    const auto with_empty_calls = created(config, kSize);
    with_empty_calls->process({});
    Player(*with_empty_calls, events, 0).play_until(last_frame_us(events));
    with_empty_calls->process({});
    cv::Mat1b last;
    with_empty_calls->render(static_cast<std::int64_t>(expected.size()) * 50000, last);
    REQUIRE(are_equal(last, expected.back()));
  });
}

TEST_CASE("methods that live on events alone don't look at intensity frames, others do") {
  const std::vector<Event> events = scene(11);
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    const auto without = created(config, kSize);
    without->process(events);
    cv::Mat1b grey;
    without->render(last_frame_us(events), grey);
    REQUIRE(are_equal(grey, frames_of(config, events).back()) == (method.frames == FrameUse::none));
    REQUIRE(is_flat(grey) == (method.frames == FrameUse::required));
  });
}

TEST_CASE("an intensity frame that isn't of the sensor's size is refused in words") {
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    const auto reconstructor = created(config, kSize);
    if (method.frames == FrameUse::none) return;
    REQUIRE_THROWS_WITH(reconstructor->observe({{0, 0}, cv::Mat1b(kSize.height_px, kSize.width_px - 1)}),
                        Contains(std::string(method.name)) && Contains("39x32") && Contains("40x32"));
  });
}

TEST_CASE("intensity frames of 8 and of 16 bits mean the same") {
  const std::vector<Event> events = scene(12);
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    if (method.frames == FrameUse::none) return;
    const auto coarse = created(config, kSize);
    const auto fine = created(config, kSize);
    for (const auto& reconstructor : {coarse.get(), fine.get()}) reconstructor->process(events);
    const std::int64_t t_us = events.back().t_us + 1;
    const auto grey = [](int depth_factor) { return depth_factor * 77; };
    coarse->observe({{t_us - 20000, t_us}, cv::Mat(kSize.height_px, kSize.width_px, CV_8UC1, grey(1))});
    fine->observe({{t_us - 20000, t_us}, cv::Mat(kSize.height_px, kSize.width_px, CV_16UC1, grey(257))});
    cv::Mat1f a, b;
    coarse->render_levels(t_us + 50000, a);
    fine->render_levels(t_us + 50000, b);
    REQUIRE(cv::norm(a, b, cv::NORM_INF) < 0.01);
  });
}

namespace {

bool has_windows_of_time(MethodConfig& config) {
  return is_set(config, "window", "time") ||
         (config.options().find("window_us") != nullptr && config.options().find("window") == nullptr);
}

/// Methods whose pixels depend on all others, through cells that lie fixed on the sensor.
bool sees_the_whole_image(const Method& method) { return method.name == "esi-flow"; }

}  // namespace

TEST_CASE("a shift in time shifts the frames") {
  const std::vector<Event> events = scene(4);
  for_each_variant([&](MethodConfig& config) {
    const auto expected = frames_of(config, events);
    for (const std::int64_t t_us :
         {std::int64_t{1}, std::int64_t{-7000000}, std::int64_t{1700000000000000}}) {
      // Windows of time lie on the recording's clock, so only whole windows (10 ms) shift them.
      if (t_us == 1 && has_windows_of_time(config)) continue;
      const auto frames = frames_of(config, shifted(events, t_us, 0, 0), t_us);
      REQUIRE(frames.size() == expected.size());
      for (std::size_t k = 0; k < frames.size(); ++k) REQUIRE(are_equal(frames[k], expected[k]));
    }
  });
}

TEST_CASE("a shift in space shifts the images") {
  const std::vector<Event> events = scene(5);
  const cv::Rect inner(kMargin, kMargin, kSize.width_px - 2 * kMargin, kSize.height_px - 2 * kMargin);
  for_each_method_variant([&](MethodConfig& config, const Method& method) {
    if (sees_the_whole_image(method)) return;
    const cv::Mat1b expected = frames_of(config, events).back();
    // Away from the border: a method that smooths sees no neighbours there, a network's padding mirrors what
    // is near it.
    for (const auto& [x, y] : {std::pair(3, 0), std::pair(0, -5), std::pair(-4, 4)}) {
      const cv::Mat1b moved = frames_of(config, shifted(events, 0, x, y)).back();
      REQUIRE(are_equal(moved(inner + cv::Point(x, y)), expected(inner)));
      REQUIRE_FALSE(are_equal(moved(inner), expected(inner)));
    }
  });
}

TEST_CASE("events in the sensor's corners are taken") {
  for_each_variant([&](const MethodConfig& config) {
    for (const SensorSize size :
         {SensorSize{1, 1}, SensorSize{1, 9}, SensorSize{9, 1}, SensorSize{640, 480}}) {
      const auto right = static_cast<std::uint16_t>(size.width_px - 1);
      const auto bottom = static_cast<std::uint16_t>(size.height_px - 1);
      const auto reconstructor = created(config, size);
      reconstructor->process(std::vector<Event>{
          {0, 0, 0, true}, {5, right, 0, false}, {5, 0, bottom, true}, {9, right, bottom, false}});
      cv::Mat1b grey;
      reconstructor->render(10, grey);
      REQUIRE(grey.size() == cv::Size(size.width_px, size.height_px));
    }
  });
}
