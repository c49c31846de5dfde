// What every method of the table promises about its grey levels.

#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/core.hpp>

#include "contract/method_player.hpp"

using namespace esi;
using namespace esi::test;

namespace {

/// Methods that show a past exposure: events before and behind its reference time count in opposite senses,
/// so that fewer ON events need not darken it.
bool shows_an_exposure(std::string_view method) { return method == "edi"; }

cv::Mat1f last_levels(const MethodConfig& config, const std::vector<Event>& events,
                      const std::vector<float>& weights = {}) {
  cv::Mat1f levels;
  played(config, events, weights)->render_levels(last_frame_us(events), levels);
  return levels;
}

/// What mirrors when polarities are swapped: what is shown, or the L that it is the exponential of.
enum class Mirrors { level, logarithm };

/// 255 (exp(L) - 1 - show_min) / (show_max - show_min), as `highpass` and `complementary` show L.
struct LogDisplay {
  explicit LogDisplay(MethodConfig& config)
      : black(config.options().at("show_min").json()), white(config.options().at("show_max").json()) {}
  double l_of(double level) const { return std::log1p(black + level * (white - black) / 255.0); }
  double level_of(double l) const { return 255.0 * (std::expm1(l) - black) / (white - black); }
  double black, white;
};

/// How far the one image is from the other mirrored about neutral, in grey levels.
double mirror_error(MethodConfig& config, Mirrors mirrors, const std::vector<Event>& events) {
  std::vector<Event> swapped = events;
  for (Event& event : swapped) event.on = !event.on;
  const cv::Mat1f a = last_levels(config, events);
  const cv::Mat1f b = last_levels(config, swapped);
  // Neutral is what there is without the events, be it an intensity frame.
  const cv::Mat1f neutral = last_levels(config, events, std::vector<float>(events.size(), 0.0F));
  REQUIRE(cv::norm(a, b, cv::NORM_INF) > 50.0);
  if (mirrors == Mirrors::level) return cv::norm(a + b, 2.0 * neutral, cv::NORM_INF);
  const LogDisplay display(config);
  double largest = 0.0;
  for (int i = 0; i < static_cast<int>(a.total()); ++i) {
    const double mirrored = display.level_of(2.0 * display.l_of(neutral(i)) - display.l_of(a(i)));
    largest = std::max(largest, std::abs(mirrored - static_cast<double>(b(i))));
  }
  return largest;
}

/// Many events of one pixel at once, then some apart; all in the first intensity frame's exposure or soon
/// after.
std::vector<Event> flood(bool on, bool alternates) {
  std::vector<Event> events;
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t t_us = 10000 + (i < 10000 ? 0 : 7 * (i - 10000));
    events.push_back({t_us, 20, 15, on != (alternates && i % 2 == 1)});
  }
  return events;
}

}  // namespace

TEST_CASE("a recording without events gives flat images, and one with events doesn't") {
  const std::vector<Event> events = scene(3);
  for_each_variant([&](const MethodConfig& config) {
    const auto reconstructor = created(config, kSize);
    cv::Mat1b grey;
    for (const std::int64_t t_us : {std::int64_t{0}, std::int64_t{10000}, std::int64_t{1} << 50}) {
      reconstructor->render(t_us, grey);
      REQUIRE(grey.size() == cv::Size(kSize.width_px, kSize.height_px));
      REQUIRE(is_flat(grey));
    }
    REQUIRE_FALSE(is_flat(frames_of(config, events).back()));
  });
}

TEST_CASE("grey levels are the image before rounding") {
  const std::vector<Event> events = scene(9);
  for_each_variant([&](const MethodConfig& config) {
    const auto reconstructor = played(config, events);
    const std::int64_t t_us = last_frame_us(events);
    cv::Mat1b grey;
    cv::Mat1f levels;
    reconstructor->render(t_us, grey);
    reconstructor->render_levels(t_us, levels);
    REQUIRE(cv::checkRange(levels));
    cv::Mat1b rounded;
    levels.convertTo(rounded, CV_8U);
    REQUIRE(cv::norm(grey, rounded, cv::NORM_INF) <= 1);  // halves may go either way
    REQUIRE(cv::countNonZero(grey != rounded) <= 40);
  });
}

TEST_CASE("events that each count 1 are events without weights, others are not") {
  const std::vector<Event> events = scene(10);
  const auto last_of = [&](const MethodConfig& config, std::span<const float> weights) {
    cv::Mat1b grey;
    played(config, events, weights)->render(last_frame_us(events), grey);
    return grey;
  };
  for_each_method_variant([&](MethodConfig& config, const Method& method) {
    std::vector<float> weights(events.size(), 1.0F);
    const cv::Mat1b expected = last_of(config, {});
    REQUIRE(are_equal(last_of(config, weights), expected));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = events[i].on ? 0.5F : 1.0F;
    const cv::Mat1b weighted = last_of(config, weights);
    REQUIRE_FALSE(are_equal(weighted, expected));
    // A normalised voxel grid, and an image stretched to its percentiles or its deviation, have the same mean
    // whatever ON events count.
    if (is_set(config, "normalise", "true") || is_set(config, "range", "percentiles")) return;
    if (config.options().find("contrast_deviations") != nullptr) return;
    if (!shows_an_exposure(method.name)) REQUIRE(cv::mean(weighted)[0] < cv::mean(expected)[0]);
  });
}

TEST_CASE("the image takes the sensor's size, whatever the caller hands over") {
  const std::vector<Event> events = scene(6);
  for_each_variant([&](const MethodConfig& config) {
    const cv::Mat1b expected = frames_of(config, events).back();
    const auto reconstructor = played(config, events);
    cv::Mat1b larger(100, 100, static_cast<std::uint8_t>(7));
    cv::Mat1b part_of_larger = larger(cv::Rect(10, 20, kSize.width_px, kSize.height_px));
    cv::Mat1b wrong_size(3, 5);
    const std::int64_t t_us = last_frame_us(events);
    reconstructor->render(t_us, part_of_larger);
    reconstructor->render(t_us, wrong_size);
    REQUIRE(are_equal(part_of_larger, expected));
    REQUIRE(are_equal(wrong_size, expected));
    REQUIRE(cv::countNonZero(larger != 7) <= kSize.width_px * kSize.height_px);
  });
}

// Of the others `edi` and `edi-propagated` are exponential in the events, and a network isn't linear. By
// itself the accumulator's neutral is its lower bound.
TEST_CASE("swapping all polarities mirrors the image of a linear method about neutral") {
  struct Linear {
    const char* method;
    const char* setting;  ///< that makes it symmetric
    Mirrors mirrors;
  };
  const auto linear = GENERATE(
      Linear{"esi", nullptr, Mirrors::level}, Linear{"esi-adaptive", nullptr, Mirrors::level},
      Linear{"esi-adaptive", "balance=false", Mirrors::level},
      Linear{"accumulator", "v_neutral=0.5", Mirrors::level}, Linear{"highpass", nullptr, Mirrors::logarithm},
      Linear{"complementary", nullptr, Mirrors::logarithm});
  const std::vector<Event> events = scene(13);
  int variants = 0;
  for_each_method_variant([&](MethodConfig& config, const Method& method) {
    if (method.name != linear.method) return;
    ++variants;
    if (linear.setting != nullptr) config.options().set_assignment(linear.setting);
    REQUIRE(mirror_error(config, linear.mirrors, events) < 0.01);  // 1 is promised, of rounded levels
  });
  CHECK(variants > 0);
}

TEST_CASE("whatever a pixel fires, grey levels stay finite") {
  const int kind = GENERATE(0, 1, 2);
  const std::vector<Event> events = flood(kind != 1, kind == 2);
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    const auto reconstructor = created(config, kSize);
    Player player(*reconstructor, events, 0);
    cv::Mat1f levels;
    for (const std::int64_t t_us : {std::int64_t{10001}, last_frame_us(events), std::int64_t{1} << 50}) {
      player.play_until(t_us);
      reconstructor->render_levels(t_us, levels);
      INFO(method.name << " at " << t_us << " us");
      REQUIRE(cv::checkRange(levels));
    }
  });
}
