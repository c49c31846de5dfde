// What the paper claims of ESI.

#include <catch2/catch.hpp>
#include <ctime>
#include <iostream>
#include <opencv2/core.hpp>

#include "esi/core/packet.hpp"
#include "esi/recon/esi.hpp"
#include "support/random_events.hpp"

using namespace esi;

namespace {

#if defined(__has_feature)
#define ESI_HAS_FEATURE(x) __has_feature(x)
#else
#define ESI_HAS_FEATURE(x) 0
#endif
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !ESI_HAS_FEATURE(address_sanitizer) && !ESI_HAS_FEATURE(thread_sanitizer)
constexpr bool kIsTimed = true;
#else
constexpr bool kIsTimed = false;
#endif

cv::Mat1b rendered(Esi& esi, std::int64_t t_us) {
  cv::Mat1b grey;
  esi.render(t_us, grey);
  return grey;
}

double largest_difference(const cv::Mat1b& a, const cv::Mat1b& b) { return cv::norm(a, b, cv::NORM_INF); }

/// A scene that moves on: at each step, an upright bright bar of 4 columns goes one column to the right,
/// which is 3 ON events a pixel at its front and 3 OFF events at its back.
std::vector<Event> bar_step(SensorSize size, int step, std::int64_t t_us) {
  std::vector<Event> events;
  const auto column = [&](int x, bool on) {
    const auto wrapped = static_cast<std::uint16_t>(x % size.width_px);
    for (int k = 0; k < 3; ++k) {
      for (int y = 0; y < size.height_px; ++y) {
        events.push_back({t_us + k * 100, wrapped, static_cast<std::uint16_t>(y), on});
      }
    }
  };
  column(step + 4, true);
  column(step, false);
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.t_us < b.t_us; });
  return events;
}

/// Grey of the bar minus grey of the rest, after `steps` of 20 ms from t = 0. `flash` events of one polarity
/// come at every pixel at once before step `flash_step`.
double contrast_of_bar(int steps, int flash_step, int flash) {
  const SensorSize size{24, 4};
  Esi esi(EsiOptions{}, size);
  for (int step = 0; step < steps; ++step) {
    const std::int64_t t_us = step * 20000;
    for (int k = 0; step == flash_step && k < flash; ++k) {
      for (std::uint16_t i = 0; i < 24 * 4; ++i) {
        esi.process(std::vector<Event>{
            {t_us - 1000, static_cast<std::uint16_t>(i % 24), static_cast<std::uint16_t>(i / 24), true}});
      }
    }
    esi.process(bar_step(size, step, t_us));
  }
  const cv::Mat1b grey = rendered(esi, steps * 20000);
  cv::Mat1b is_bar(grey.size(), 0);
  for (int x = steps; x < steps + 4; ++x) is_bar.col(x % size.width_px).setTo(255);
  return cv::mean(grey, is_bar)[0] - cv::mean(grey, ~is_bar)[0];
}

}  // namespace

TEST_CASE("the state is two scalars a pixel") {
  STATIC_REQUIRE(sizeof(EsiPixel) == 8);
  const Esi esi(EsiOptions{}, {346, 260});
  CHECK(esi.pixels().size() == 346 * 260);
}

TEST_CASE("a hot pixel neither rules the contrast nor touches other pixels") {
  const test::Region region{0, 0, 16, 12};
  const std::vector<Event> scene = test::random_events(region, 3000, 200, 1);
  std::vector<Event> with_hot_pixel;
  std::int64_t t_hot_us = 0;
  for (const Event& event : scene) {
    for (; t_hot_us < event.t_us; t_hot_us += 50) with_hot_pixel.push_back({t_hot_us, 3, 2, true});  // 20 kHz
    with_hot_pixel.push_back(event);
  }
  Esi clean(EsiOptions{}, {16, 12});
  Esi hot(EsiOptions{}, {16, 12});
  clean.process(scene);
  hot.process(with_hot_pixel);
  const std::int64_t t_us = scene.back().t_us + 1;
  const cv::Mat1b expected = rendered(clean, t_us);
  const cv::Mat1b grey = rendered(hot, t_us);
  CHECK(grey(2, 3) >= 191);  // at the clamp, but for a last OFF event
  cv::Mat1b others = expected.clone();
  others(2, 3) = grey(2, 3);
  CHECK(largest_difference(grey, others) == 0);
  CHECK(hot.pixels()[2 * 16 + 3].e <= static_cast<float>(EsiOptions{}.e_max));
}

TEST_CASE("a jump of the illumination is survived: the scene's contrast comes back as it moves on") {
  const double undisturbed = contrast_of_bar(60, -1, 0);
  REQUIRE(undisturbed > 150.0);
  for (const int flash : {1, 5, 50}) {
    CHECK(contrast_of_bar(37, 36, flash) < undisturbed - 30.0);                 // it does disturb
    CHECK(contrast_of_bar(60, 36, flash) == Approx(undisturbed).margin(10.0));  // 24 steps later
  }
}

TEST_CASE("what was seen longer than tau ago leaves no trace") {
  EsiOptions options;
  options.decay.tau_s = 0.5;
  Esi with_past(options, {16, 12});
  Esi without(options, {16, 12});
  with_past.process(test::random_events({0, 0, 16, 12}, 5000, 100, 2));
  std::vector<Event> present = test::random_events({0, 0, 16, 12}, 5000, 10, 3);
  for (Event& event : present) event.t_us += 10000000;
  with_past.process(present);
  without.process(present);
  const std::int64_t t_us = present.back().t_us + 1;
  CHECK(largest_difference(rendered(with_past, t_us), rendered(without, t_us)) == 0);
}

TEST_CASE("12 million events a second at 100 frames a second take less than real time on one core") {
  if (!kIsTimed) {
    std::cerr << "SKIPPED: not a release build\n";
    return;
  }
  const SensorSize size = GENERATE(SensorSize{346, 260}, SensorSize{1280, 720});
  Esi esi(EsiOptions{}, size);
  cv::Mat1b grey;
  const std::clock_t begin = std::clock();
  std::clock_t generating = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const std::clock_t before = std::clock();
    std::vector<Event> events =
        test::random_events({0, 0, size.width_px, size.height_px}, 120000, 0, static_cast<unsigned>(frame));
    for (std::size_t i = 0; i < events.size(); ++i)
      events[i].t_us = frame * 10000 + static_cast<std::int64_t>(i / 12);
    generating += std::clock() - before;
    for (std::size_t i = 0; i < events.size(); i += kPacketEvents) {
      esi.process(std::span(events).subspan(i, std::min(kPacketEvents, events.size() - i)));
    }
    esi.render((frame + 1) * 10000, grey);
  }
  const double cpu_s = static_cast<double>(std::clock() - begin - generating) / CLOCKS_PER_SEC;
  CHECK(cpu_s < 1.0);
}
