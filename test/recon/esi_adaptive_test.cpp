#include "esi/recon/esi_adaptive.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "balance_reference.hpp"
#include "esi/recon/steps/stepped_reconstructor.hpp"
#include "esi_reference.hpp"
#include "support/random_events.hpp"

using namespace esi;

namespace {

constexpr SensorSize kSize{23, 17};

/// Everything off.
EsiAdaptiveOptions plain() {
  EsiAdaptiveOptions options;
  options.esi = {};
  options.balance.balance = false;
  options.background_us = 0;
  options.smoothing = {};
  return options;
}

std::vector<EsiAdaptiveOptions> variants() {
  std::vector<EsiAdaptiveOptions> all(7, plain());
  all[1].balance.balance = true;
  all[2].background_us = 300;
  all[3].smoothing.median = true;
  all[4].smoothing.blur_px = 0.7;
  all[5] = {};  // the defaults
  all[6].balance = {.balance = true, .prior = 3.0, .ratio = 0.6, .cap = 9};
  all[6].background_us = 100;
  all[6].smoothing = {.median = true, .blur_px = 1.2};
  all[6].esi.decay.decay = Decay::exponential;
  all[6].esi.decay.alpha_hz = 30.0;
  all[6].esi.c_on = 0.4;
  all[6].esi.readout_decay = true;
  return all;
}

/// ESI with the steps of the same names around it.
std::unique_ptr<Reconstructor> composed(const EsiAdaptiveOptions& options, RemovedEvents& removed) {
  StepOptions steps;
  steps.balance = options.balance;
  steps.filters.background_us = options.background_us;
  steps.smoothing = options.smoothing;
  return with_steps(std::make_unique<Esi>(options.esi, kSize), steps, {kSize, {}, {}, {}}, removed);
}

/// Random events, ON being rarer, with a rest of an hour in the middle.
std::vector<Event> stream(unsigned seed) {
  auto events = test::random_events({0, 0, kSize.width_px, kSize.height_px}, 30000, 8, seed);
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i].on = random() % 100 < 35;
    if (i >= events.size() / 2) events[i].t_us += 3'600'000'000;
  }
  return events;
}

cv::Mat1f levels_of(Reconstructor& method, std::int64_t t_us) {
  cv::Mat1f levels;
  method.render_levels(t_us, levels);
  return levels;
}

int grey_in_the_middle(const EsiAdaptiveOptions& options, const std::vector<Event>& events) {
  EsiAdaptive method(options, {3, 3});
  method.process(events);
  cv::Mat1b grey;
  method.render(events.back().t_us + 1, grey);
  return grey(1, 1);
}

}  // namespace

TEST_CASE("each block gives, bit for bit, what the step of its name gives around ESI") {
  const auto events = stream(21);
  std::mt19937 random(5);
  std::vector<float> weights;
  for (std::size_t i = 0; i < events.size(); ++i)
    weights.push_back(0.5F + static_cast<float>(random() % 100) / 64.0F);
  for (const bool is_weighted : {false, true}) {
    for (const EsiAdaptiveOptions& options : variants()) {
      EsiAdaptive fused(options, kSize);
      RemovedEvents removed;
      const auto steps = composed(options, removed);
      for (std::size_t i = 0; i < events.size(); i += 6000) {
        const auto part = std::span(events).subspan(i, 6000);
        const auto given = is_weighted ? std::span(weights).subspan(i, 6000) : std::span<const float>();
        fused.process(part, given);
        steps->process(part, given);
        const std::int64_t t_us = part.back().t_us + 100;
        REQUIRE(cv::norm(levels_of(fused, t_us), levels_of(*steps, t_us), cv::NORM_INF) == 0);
      }
      CHECK((removed.background > 1000) == (options.background_us > 0));
    }
  }
}

TEST_CASE("with all blocks off it is ESI, and each block makes a difference") {
  const auto events = stream(22);
  const std::int64_t t_us = events.back().t_us + 1;
  Esi esi(EsiOptions{}, kSize);
  esi.process(events);
  const cv::Mat1f expected = levels_of(esi, t_us);
  const auto all = variants();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EsiAdaptive method(all[i], kSize);
    method.process(events);
    CHECK((cv::norm(levels_of(method, t_us), expected, cv::NORM_INF) == 0) == (i == 0));
  }
}

TEST_CASE("balanced ESI agrees with its equations in double precision") {
  EsiAdaptiveOptions options = plain();
  options.balance.balance = true;
  const auto events = stream(23);
  EsiAdaptive method(options, kSize);
  method.process(events);
  test::BalanceReference balance(options.balance, kSize);
  struct Pixel {
    double e = 0.0;
    std::int64_t t_us = 0;
  };
  std::vector<Pixel> pixels(static_cast<std::size_t>(kSize.width_px * kSize.height_px));
  for (const Event& event : events) {
    Pixel& pixel = pixels[event.y * static_cast<std::size_t>(kSize.width_px) + event.x];
    const double weight = balance.weigh(event);
    pixel.e *= test::reference_gamma(options.esi.decay, static_cast<double>(event.t_us - pixel.t_us) * 1e-6);
    pixel.e = std::clamp(pixel.e + (event.on ? weight : -weight), -2.0, 2.0);
    pixel.t_us = event.t_us;
  }
  const cv::Mat1f levels = levels_of(method, events.back().t_us + 1);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto x = static_cast<int>(i) % kSize.width_px;
    const auto y = static_cast<int>(i) / kSize.width_px;
    REQUIRE(static_cast<double>(levels(y, x)) == Approx(127.5 + 63.75 * pixels[i].e).margin(255 * 1e-5));
  }
}

TEST_CASE("3x3 pixels show what the equations say") {
  // No decay, and grey 127.5 + 63.75 E.
  EsiAdaptiveOptions options = plain();
  options.esi.decay.decay = Decay::none;
  const std::vector<Event> two_on{{0, 1, 1, true}, {10, 1, 1, true}};
  CHECK(grey_in_the_middle(options, two_on) == 255);

  EsiAdaptiveOptions balanced = options;
  balanced.balance = {.balance = true, .prior = 2.0, .ratio = 1.0, .cap = 63};
  CHECK(grey_in_the_middle(balanced, two_on) == 236);  // 1 + sqrt(1/2)
  balanced.balance.ratio = 4.0;
  CHECK(grey_in_the_middle(balanced, {two_on[0]}) == 159);  // sqrt(0.4 / 1.6)

  EsiAdaptiveOptions filtered = options;
  filtered.background_us = 10;
  CHECK(grey_in_the_middle(filtered, two_on) == 128);
  CHECK(grey_in_the_middle(filtered, {{0, 0, 0, true}, {10, 1, 1, true}}) == 191);

  EsiAdaptiveOptions median = options;
  median.smoothing.median = true;
  CHECK(grey_in_the_middle(median, two_on) == 128);

  EsiAdaptiveOptions blurred = options;
  blurred.smoothing.blur_px = 0.7;
  // The image's middle weighs 0.570 a side, mirrored borders fall back onto it at distance 2.
  const int grey = grey_in_the_middle(blurred, two_on);
  CHECK(grey > 160);
  CHECK(grey < 190);
}
