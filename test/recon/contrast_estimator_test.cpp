// Whether the contrast threshold is found again that synthetic events were made with.

#include "esi/recon/contrast_estimator.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <opencv2/core.hpp>
#include <random>

#include "esi/recon/edi.hpp"

using namespace esi;

namespace {

constexpr SensorSize kSize{40, 30};
constexpr std::int64_t kFramePeriod_us = 40000;
constexpr std::int64_t kExposure_us = 20000;

/// Every pixel's log intensity is a sine of its own: a texture that moves.
class Scene {
 public:
  Scene(double contrast, unsigned seed, double brightness = 0.0) : random_(seed) {
    for (int y = 0; y < kSize.height_px; ++y) {
      for (int x = 0; x < kSize.width_px; ++x) {
        pixels_.push_back(
            {brightness + uniform(-1.5, -1.1), uniform(0.1, 1.1), uniform(2.0, 9.0), uniform(0.0, 6.3)});
        add_events(x, y, contrast);
      }
    }
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.t_us < b.t_us; });
  }

  double log_intensity(int x, int y, double t_us) const {
    const Pixel& p = pixels_[static_cast<std::size_t>(y * kSize.width_px + x)];
    return p.mean + p.amplitude * std::sin(2.0e-6 * 3.14159265 * p.frequency_hz * t_us + p.phase);
  }

  cv::Mat exposed(Interval exposure, int bits) const {
    cv::Mat1f image(kSize.height_px, kSize.width_px);
    for (int y = 0; y < kSize.height_px; ++y) {
      for (int x = 0; x < kSize.width_px; ++x) image(y, x) = static_cast<float>(mean_in(x, y, exposure));
    }
    cv::Mat frame;
    image.convertTo(frame, bits == 8 ? CV_8U : CV_16U, bits == 8 ? 255.0 : 65535.0);
    return frame;
  }

  std::span<const Event> events() const { return events_; }

 private:
  struct Pixel {
    double mean, amplitude, frequency_hz, phase;
  };

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

  double mean_in(int x, int y, Interval exposure) const {
    double sum = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      const double t_us = static_cast<double>(exposure.begin_us) + (i + 0.5) / kSteps * kExposure_us;
      sum += std::exp(log_intensity(x, y, t_us)) / kSteps;
    }
    return sum;
  }

  void add_events(int x, int y, double contrast) {
    double level = log_intensity(x, y, 0) + uniform(-contrast, contrast);
    for (std::int64_t t_us = 0; t_us < 12 * kFramePeriod_us; t_us += 100) {
      const double l = log_intensity(x, y, static_cast<double>(t_us));
      for (; l - level >= contrast; level += contrast) push(t_us, x, y, true);
      for (; level - l >= contrast; level -= contrast) push(t_us, x, y, false);
    }
  }

  void push(std::int64_t t_us, int x, int y, bool on) {
    events_.push_back({t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), on});
  }

  std::mt19937 random_;
  std::vector<Pixel> pixels_;
  std::vector<Event> events_;
};

Interval exposure_of(int k) {
  return {k * kFramePeriod_us + 1000, k * kFramePeriod_us + 1000 + kExposure_us};
}

/// Plays frames and events in their order; calls `after_frame(k)` behind each frame.
template <class AfterFrame>
void play(const Scene& scene, Reconstructor& method, int frames, int bits, AfterFrame after_frame) {
  auto events = scene.events();
  for (int k = 0; k < frames; ++k) {
    const Interval exposure = exposure_of(k);
    std::size_t due = 0;
    while (due < events.size() && events[due].t_us < exposure.end_us) ++due;
    method.process(events.first(due));
    events = events.subspan(due);
    method.observe({exposure, scene.exposed(exposure, bits)});
    after_frame(k);
  }
}

}  // namespace

TEST_CASE("the contrast threshold of synthetic events is found within 4 %") {
  const double contrast = GENERATE(0.08, 0.15, 0.25, 0.4);
  const int bits = GENERATE(8, 16);
  const Scene scene(contrast, 5);
  Edi edi({}, kSize);
  CHECK(edi.contrast() == Deblur::kFirstContrast);
  play(scene, edi, 10, bits, [&](int k) {
    if (k == 0) CHECK(edi.contrast() == Deblur::kFirstContrast);
  });
  CHECK(edi.contrast() == Approx(contrast).epsilon(0.04));
}

TEST_CASE("pixels that fire without end hardly change the estimate") {
  const Scene scene(0.2, 6);
  Edi edi({}, kSize);
  auto events = std::vector<Event>(scene.events().begin(), scene.events().end());
  for (std::int64_t t_us = 0; t_us < 400000; t_us += 500) {
    for (const int x : {3, 17, 31}) events.push_back({t_us, static_cast<std::uint16_t>(x), 11, true});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.t_us < b.t_us; });
  std::span<const Event> rest = events;
  for (int k = 0; k < 9; ++k) {
    std::size_t due = 0;
    while (due < rest.size() && rest[due].t_us < exposure_of(k).end_us) ++due;
    edi.process(rest.first(due));
    rest = rest.subspan(due);
    edi.observe({exposure_of(k), scene.exposed(exposure_of(k), 8)});
  }
  CHECK(edi.contrast() == Approx(0.2).epsilon(0.08));
}

TEST_CASE("where frames and events don't belong together the first guess stays") {
  const Scene scene(0.2, 7);
  const Scene other(0.2, 8);
  Edi edi({}, kSize);
  auto events = scene.events();
  for (int k = 0; k < 8; ++k) {
    std::size_t due = 0;
    while (due < events.size() && events[due].t_us < exposure_of(k).end_us) ++due;
    edi.process(events.first(due));
    events = events.subspan(due);
    edi.observe({exposure_of(k), other.exposed(exposure_of(k), 8)});
  }
  CHECK(edi.contrast() == Deblur::kFirstContrast);
}

TEST_CASE("under- and overexposed pixels don't change the estimate") {
  const double brightness = GENERATE(1.3, -2.0);
  const Scene scene(0.2, 11, brightness);
  Edi edi({}, kSize);
  play(scene, edi, 10, 8, [](int) {});
  CHECK(edi.contrast() == Approx(0.2).epsilon(0.1));
}

TEST_CASE("a frame is made sharp with the estimate that it took part in") {
  const Scene scene(0.1, 12);
  Edi edi({}, kSize);
  double before = 0.0;
  play(scene, edi, 2, 8, [&](int k) {
    if (k == 0) before = edi.contrast();
  });
  REQUIRE(edi.contrast() != before);
  Edi knowing({.contrast = edi.contrast()}, kSize);
  play(scene, knowing, 2, 8, [](int) {});
  cv::Mat1f levels, expected;
  edi.render_levels(0, levels);
  knowing.render_levels(0, expected);
  CHECK(cv::norm(levels, expected, cv::NORM_INF) == 0);
}

TEST_CASE("a given contrast threshold is kept") {
  const Scene scene(0.2, 9);
  Edi edi({.contrast = 0.33}, kSize);
  play(scene, edi, 6, 8, [](int) {});
  CHECK(edi.contrast() == 0.33);
}

TEST_CASE("edi is nearer to the true intensity than the blurred frame, and stays so carried on") {
  const Scene scene(0.1, 10);
  Edi edi({}, kSize);
  EdiPropagated propagated({}, kSize);
  const auto error_of = [&](const cv::Mat1f& shares, std::int64_t t_us) {
    double sum = 0.0;
    for (int y = 0; y < kSize.height_px; ++y) {
      for (int x = 0; x < kSize.width_px; ++x) {
        sum += std::abs(std::log(static_cast<double>(shares(y, x)) / 255.0) -
                        scene.log_intensity(x, y, static_cast<double>(t_us)));
      }
    }
    return sum / (kSize.width_px * kSize.height_px);
  };
  const auto middle_us = [](int k) { return exposure_of(k).begin_us + kExposure_us / 2; };
  play(scene, propagated, 8, 16, [](int) {});
  play(scene, edi, 8, 16, [&](int k) {
    if (k < 2) return;
    cv::Mat1f sharp, blurred;
    edi.render_levels(0, sharp);
    cv::Mat(scene.exposed(exposure_of(k), 16)).convertTo(blurred, CV_32F, 255.0 / 65535.0);
    CHECK(error_of(sharp, middle_us(k)) < 0.035);
    CHECK(error_of(sharp, exposure_of(k).end_us) > 0.05);  // it shows the middle, no other time
  });
  cv::Mat1f now;
  propagated.render_levels(0, now);
  CHECK(error_of(now, exposure_of(7).end_us) < 0.07);
}

TEST_CASE("the median of ratios counts by events, and needs enough of them") {
  ContrastEstimator estimator;
  const cv::Mat1f two(10, 5, 2.0F), six(10, 5, 6.0F);
  const cv::Mat1b yes(10, 5, static_cast<std::uint8_t>(255)), no(10, 5, static_cast<std::uint8_t>(0));
  estimator.add(cv::Mat1f(10, 5, 0.6F), six, yes);
  CHECK_FALSE(estimator.contrast());  // 50 pixels
  estimator.add(cv::Mat1f(10, 5, 0.6F), six, no);
  estimator.add(cv::Mat1f(10, 5, 0.6F), two, yes);  // too few events each
  CHECK_FALSE(estimator.contrast());
  estimator.add(cv::Mat1f(10, 5, -0.6F), cv::Mat1f(10, 5, -6.0F), yes);
  REQUIRE(estimator.contrast());
  CHECK(*estimator.contrast() == Approx(0.1).margin(0.0005));
  // As many pixels with half the events: the median stays with the heavier ones.
  estimator.add(cv::Mat1f(10, 5, 1.2F), cv::Mat1f(10, 5, 3.0F), yes);
  estimator.add(cv::Mat1f(10, 5, 1.2F), cv::Mat1f(10, 5, 3.0F), yes);
  CHECK(*estimator.contrast() == Approx(0.1).margin(0.0005));
  // Signs that contradict: nothing can be said.
  estimator.add(cv::Mat1f(10, 5, -1.0F), cv::Mat1f(10, 5, 60.0F), yes);
  CHECK_FALSE(estimator.contrast());
}
