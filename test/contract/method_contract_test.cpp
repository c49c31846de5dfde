// What every method of the table promises, whatever it does inside.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <random>
#include <set>
#include <sstream>

#include "contract/methods_under_test.hpp"
#include "esi/core/error.hpp"
#include "esi/pipeline/recon_config.hpp"
#include "esi/recon/methods.hpp"
#include "support/random_events.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kSize{40, 32};
/// Events keep away this far from the border, so that a shift keeps them inside.
constexpr int kMargin = 8;

std::vector<Event> scene(unsigned seed) {
  const test::Region inner{kMargin, kMargin, kSize.width_px - 2 * kMargin, kSize.height_px - 2 * kMargin};
  return test::random_events(inner, 20000, 20, seed);
}

std::vector<Event> shifted(std::vector<Event> events, std::int64_t t_us, int x, int y) {
  for (Event& event : events) {
    event.t_us += t_us;
    event.x = static_cast<std::uint16_t>(event.x + x);
    event.y = static_cast<std::uint16_t>(event.y + y);
  }
  return events;
}

/// An intensity frame every 40 ms, exposed for 25 ms; each flat, so that a shift in space changes nothing.
IntensityFrame intensity_frame(int k, std::int64_t t0_us) {
  const std::int64_t end_us = t0_us + 30000 + k * 40000;
  return {{end_us - 25000, end_us},
          cv::Mat1b(kSize.height_px, kSize.width_px, static_cast<std::uint8_t>(90 + 10 * (k % 6)))};
}

/// Plays events in calls of `call_size()` each, with the intensity frames in their places among them, as long
/// as there are events.
class Player {
 public:
  Player(Reconstructor& reconstructor, std::span<const Event> events, std::int64_t t0_us,
         std::span<const float> weights = {})
      : reconstructor_(reconstructor),
        events_(events),
        weights_(weights),
        t0_us_(t0_us),
        t_last_us_(events.back().t_us) {}

  bool is_at_end() const { return events_.empty(); }

  /// Everything before t_us.
  template <class CallSize>
  void play_until(std::int64_t t_us, CallSize call_size) {
    for (; intensity_frame(seen_, t0_us_).exposure.end_us <= std::min(t_us, t_last_us_); ++seen_) {
      const IntensityFrame frame = intensity_frame(seen_, t0_us_);
      feed(frame.exposure.end_us, call_size);
      reconstructor_.observe(frame);
    }
    feed(t_us, call_size);
  }
  void play_until(std::int64_t t_us) {
    play_until(t_us, [] { return std::size_t{1000000}; });
  }

 private:
  template <class CallSize>
  void feed(std::int64_t t_us, CallSize call_size) {
    std::size_t due = 0;
    while (due < events_.size() && events_[due].t_us < t_us) ++due;
    while (due > 0) {
      const std::size_t count = std::min<std::size_t>(due, call_size());
      reconstructor_.process(events_.first(count), weights_.first(std::min(count, weights_.size())));
      events_ = events_.subspan(count);
      weights_ = weights_.subspan(std::min(count, weights_.size()));
      due -= count;
    }
  }

  Reconstructor& reconstructor_;
  std::span<const Event> events_;
  std::span<const float> weights_;
  std::int64_t t0_us_;
  std::int64_t t_last_us_;  ///< last event
  int seen_ = 0;            ///< intensity frames
};

/// Frames every 50 ms from t0_us on, the events given in calls of `call_size()` each.
template <class CallSize>
std::vector<cv::Mat1b> frames_of(Reconstructor& reconstructor, std::span<const Event> events,
                                 std::int64_t t0_us, CallSize call_size) {
  std::vector<cv::Mat1b> frames;
  Player player(reconstructor, events, t0_us);
  while (!player.is_at_end()) {
    const std::int64_t t_us = t0_us + static_cast<std::int64_t>(frames.size() + 1) * 50000;
    player.play_until(t_us, call_size);
    reconstructor.render(t_us, frames.emplace_back());
  }
  return frames;
}

bool is_set(MethodConfig& config, std::string_view option, std::string_view value) {
  Option* const found = config.options().find(option);
  return found != nullptr && found->text() == value;
}

std::vector<cv::Mat1b> frames_of(const MethodConfig& config, std::span<const Event> events,
                                 std::int64_t t0_us = 0) {
  const auto reconstructor = test::created(config, kSize);
  return frames_of(*reconstructor, events, t0_us, [] { return std::size_t{1000000}; });
}

/// The time of the last of those frames.
std::int64_t last_frame_us(std::span<const Event> events) { return (events.back().t_us / 50000 + 1) * 50000; }

/// A reconstructor that has seen all events and intensity frames up to that time.
std::unique_ptr<Reconstructor> played(const MethodConfig& config, std::span<const Event> events,
                                      std::span<const float> weights = {}) {
  auto reconstructor = test::created(config, kSize);
  Player(*reconstructor, events, 0, weights).play_until(last_frame_us(events));
  return reconstructor;
}

/// Methods that show a past exposure: events before and behind its reference time count in opposite senses,
/// so that fewer ON events need not darken it.
bool shows_an_exposure(std::string_view method) { return method == "edi"; }

bool are_equal(const cv::Mat1b& a, const cv::Mat1b& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

bool is_flat(const cv::Mat1b& grey) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(grey, &low, &high);
  return low == high;
}

/// Runs `check(config, method)` for every method, and again for each of its choices and switches.
template <class CheckBoth>
void for_each_method_variant(CheckBoth check_both) {
  for (const Method& method : methods()) {
    const auto check = [&](MethodConfig& config) { check_both(config, method); };
    INFO("method " << method.name);
    check(*test::configured(method));
    const auto defaults = test::configured(method);
    for (const Option& option : defaults->options().options()) {
      const auto value = option.json();
      const auto variant = test::configured(method);
      if (option.is_switch()) {
        INFO(option.name() << " switched");
        variant->options().at(option.name()).set_json(!value.get<bool>());
        check(*variant);
      } else if (option.domain().find(" | ") != std::string::npos) {
        std::stringstream names(option.domain());
        for (std::string name; names >> name;) {
          if (name == "|") continue;
          INFO(option.name() << "=" << name);
          variant->options().at(option.name()).set_text(name);
          check(*variant);
        }
      }
    }
  }
}

template <class Check>
void for_each_variant(Check check) {
  for_each_method_variant([&check](MethodConfig& config, const Method&) { check(config); });
}

}  // namespace

TEST_CASE("methods have names of their own, a summary and a source") {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    CHECK(names.insert(method.name).second);
    CHECK_FALSE(method.summary.empty());
    CHECK_FALSE(method.source.empty());
    CHECK(&method_named(method.name) == &method);
  }
  CHECK(names.count("esi") == 1);
  CHECK_THROWS_WITH(method_named("esl"), Contains("'esl'") && Contains("'esi'"));
}

TEST_CASE("frames don't depend on how the events are cut into calls") {
  const std::vector<Event> events = scene(1);
  for_each_variant([&](const MethodConfig& config) {
    const auto expected = frames_of(config, events);
    REQUIRE(expected.size() > 5);
    std::mt19937 random(2);
    for (const unsigned largest : {1U, 3U, 500U}) {
      const auto cut = test::created(config, kSize);
      const auto frames = frames_of(
          *cut, events, 0, [&] { return std::size_t{1} + static_cast<std::size_t>(random() % largest); });
      REQUIRE(frames.size() == expected.size());
      for (std::size_t k = 0; k < frames.size(); ++k) REQUIRE(are_equal(frames[k], expected[k]));
    }
    const auto with_empty_calls = test::created(config, kSize);
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
    const auto without = test::created(config, kSize);
    without->process(events);
    cv::Mat1b grey;
    without->render(last_frame_us(events), grey);
    REQUIRE(are_equal(grey, frames_of(config, events).back()) == (method.frames == FrameUse::none));
    REQUIRE(is_flat(grey) == (method.frames == FrameUse::required));
  });
}

TEST_CASE("an intensity frame that isn't of the sensor's size is refused in words") {
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    const auto reconstructor = test::created(config, kSize);
    if (method.frames == FrameUse::none) return;
    REQUIRE_THROWS_WITH(reconstructor->observe({{0, 0}, cv::Mat1b(kSize.height_px, kSize.width_px - 1)}),
                        Contains(std::string(method.name)) && Contains("39x32") && Contains("40x32"));
  });
}

TEST_CASE("intensity frames of 8 and of 16 bits mean the same") {
  const std::vector<Event> events = scene(12);
  for_each_method_variant([&](const MethodConfig& config, const Method& method) {
    if (method.frames == FrameUse::none) return;
    const auto coarse = test::created(config, kSize);
    const auto fine = test::created(config, kSize);
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

TEST_CASE("a recording without events gives flat images, and one with events doesn't") {
  const std::vector<Event> events = scene(3);
  for_each_variant([&](const MethodConfig& config) {
    const auto reconstructor = test::created(config, kSize);
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
    // A normalised voxel grid, and an image stretched to its percentiles, have the same mean whatever ON
    // events count.
    if (is_set(config, "normalise", "true") || is_set(config, "range", "percentiles")) return;
    if (!shows_an_exposure(method.name)) REQUIRE(cv::mean(weighted)[0] < cv::mean(expected)[0]);
  });
}

TEST_CASE("a shift in time shifts the frames") {
  const std::vector<Event> events = scene(4);
  for_each_variant([&](MethodConfig& config) {
    const auto expected = frames_of(config, events);
    for (const std::int64_t t_us :
         {std::int64_t{1}, std::int64_t{-7000000}, std::int64_t{1700000000000000}}) {
      // Windows of time lie on the recording's clock, so only whole windows (10 ms) shift them.
      if (t_us == 1 && is_set(config, "window", "time")) continue;
      const auto frames = frames_of(config, shifted(events, t_us, 0, 0), t_us);
      REQUIRE(frames.size() == expected.size());
      for (std::size_t k = 0; k < frames.size(); ++k) REQUIRE(are_equal(frames[k], expected[k]));
    }
  });
}

TEST_CASE("a shift in space shifts the images") {
  const std::vector<Event> events = scene(5);
  const cv::Rect inner(kMargin, kMargin, kSize.width_px - 2 * kMargin, kSize.height_px - 2 * kMargin);
  for_each_variant([&](MethodConfig& config) {
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

// In `highpass` and `complementary` L itself is linear, but the display shows exp(L); `edi` and
// `edi-propagated` are exponential in the events too; and the accumulator's own neutral is its lower bound.
TEST_CASE("swapping all polarities mirrors the image of a linear method about neutral") {
  struct Linear {
    const char* method;
    std::vector<const char*> settings;  ///< that make it symmetric
  };
  const auto linear = GENERATE(
      Linear{"esi", {}}, Linear{"esi", {"decay=power"}}, Linear{"esi", {"readout_decay=true"}},
      Linear{"accumulator", {"v_neutral=0.5"}}, Linear{"accumulator", {"v_neutral=0.5", "decay=linear"}},
      Linear{"accumulator", {"v_neutral=0.5", "decay=step"}},
      Linear{"accumulator", {"v_neutral=0.5", "readout_decay=true"}});
  INFO(linear.method);
  const auto config = method_named(linear.method).configure();
  for (const char* setting : linear.settings) config->options().set_assignment(setting);
  const std::vector<Event> events = scene(13);
  std::vector<Event> swapped = events;
  for (Event& event : swapped) event.on = !event.on;
  cv::Mat1f neutral;
  config->create(kSize)->render_levels(0, neutral);
  const cv::Mat1b image = frames_of(*config, events).back();
  const cv::Mat1b mirrored = frames_of(*config, swapped).back();
  REQUIRE_FALSE(are_equal(image, mirrored));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      REQUIRE(std::abs(static_cast<float>(image(y, x) + mirrored(y, x)) - 2.0F * neutral(0, 0)) <= 1.0F);
    }
  }
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

TEST_CASE("events in the sensor's corners are taken") {
  for_each_variant([&](const MethodConfig& config) {
    for (const SensorSize size :
         {SensorSize{1, 1}, SensorSize{1, 9}, SensorSize{9, 1}, SensorSize{640, 480}}) {
      const auto right = static_cast<std::uint16_t>(size.width_px - 1);
      const auto bottom = static_cast<std::uint16_t>(size.height_px - 1);
      const auto reconstructor = test::created(config, size);
      reconstructor->process(std::vector<Event>{
          {0, 0, 0, true}, {5, right, 0, false}, {5, 0, bottom, true}, {9, right, bottom, false}});
      cv::Mat1b grey;
      reconstructor->render(10, grey);
      REQUIRE(grey.size() == cv::Size(size.width_px, size.height_px));
    }
  });
}

TEST_CASE("an option takes its bounds and refuses what lies beyond them") {
  const std::vector<Event> events = scene(7);
  for (const Method& method : methods()) {
    const auto defaults = test::configured(method);
    for (const Option& option : defaults->options().options()) {
      double low = 0.0;
      double high = 0.0;
      // "0.001 to 1000 s"
      if (std::sscanf(option.domain().c_str(), "%lf to %lf", &low, &high) != 2) continue;
      INFO(method.name << " " << option.name());
      Option& own = defaults->options().at(option.name());
      const double beyond = std::max({1.0, std::abs(low), std::abs(high)});
      for (const double wrong : {low - beyond, high + beyond, std::nan(""), HUGE_VAL}) {
        CHECK_THROWS_AS(own.set_text(fmt::format("{}", wrong)), Error);
      }
      for (const double bound : {low, high}) {
        const auto config = test::configured(method);
        config->options().at(option.name()).set_text(fmt::format("{}", bound));
        try {
          const auto frames = frames_of(*config, events);
          CHECK(frames.size() > 5);
        } catch (const Error& error) {  // it may not go together with the other defaults
          CHECK(error.kind() == Error::Kind::usage);
          CHECK_THAT(error.what(), Contains(option.name()));
        }
      }
    }
  }
}

TEST_CASE("every config for reconstruction loads and works, and a method's own has its defaults") {
  std::set<std::string> configs;
  for (const auto& file : std::filesystem::directory_iterator(test::source_dir() / "configs" / "recon")) {
    INFO(file.path());
    ReconConfig config;
    config.load(file.path());
    configs.insert(file.path().stem().string());
    if (file.path().stem() == config.method().name) {
      ReconConfig defaults;
      defaults.choose_method(std::string(config.method().name));
      CHECK(config.json()["set"] == defaults.json()["set"]);  // when frames are due is the config's own
    }
    const auto with_model = test::configured(config.method());
    if (Option* const model = with_model->options().find("model")) config.set("model=" + model->text());
    CHECK_FALSE(is_flat(frames_of(config.method_config(), scene(8)).back()));
  }
  for (const Method& method : methods()) CHECK(configs.count(std::string(method.name)) == 1);
}
