#include "esi/recon/steps/stepped_reconstructor.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"

using namespace esi;

namespace {

constexpr SensorSize kSize{4, 3};

/// Writes down what reaches it; its level is 10 a piece of weight, at the event's pixel.
class Recorder final : public Reconstructor {
 public:
  void observe(const IntensityFrame& /*frame*/) override { ++observed; }
  void render_levels(std::int64_t /*t_us*/, cv::Mat1f& levels) override { sums.copyTo(levels); }
  void use_workers(std::shared_ptr<WorkerPool> lent) override { workers = std::move(lent); }

  std::vector<Event> taken;
  std::vector<float> weights_taken;
  int observed = 0;
  std::shared_ptr<WorkerPool> workers;
  cv::Mat1f sums{kSize.height_px, kSize.width_px, 0.0F};

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override {
    for (std::size_t i = 0; i < events.size(); ++i) {
      taken.push_back(events[i]);
      if (!weights.empty()) weights_taken.push_back(weights[i]);
      sums(events[i].y, events[i].x) += 10.0F * (weights.empty() ? 1.0F : weights[i]);
    }
  }
};

struct Stepped {
  Stepped(const StepOptions& options, const StepSurroundings& surroundings) {
    auto method = std::make_unique<Recorder>();
    inner = method.get();
    outer = with_steps(std::move(method), options, surroundings, removed);
  }
  Recorder* inner;
  RemovedEvents removed;
  std::unique_ptr<Reconstructor> outer;
};

StepSurroundings plain() { return {kSize, {}, {}, {}}; }

}  // namespace

TEST_CASE("without steps the method itself comes back") {
  const Stepped stepped({}, plain());
  CHECK(stepped.outer.get() == stepped.inner);
}

TEST_CASE("workers reach the method through the steps") {
  StepOptions options;
  options.smoothing.median = true;
  const Stepped stepped(options, plain());
  const auto workers = std::make_shared<WorkerPool>(1);
  stepped.outer->use_workers(workers);
  CHECK(stepped.inner->workers == workers);
}

TEST_CASE("every step alone puts something around the method") {
  StepOptions options;
  StepSurroundings surroundings = plain();
  switch (GENERATE(0, 1, 2, 3, 4, 5, 6, 7)) {
    case 0:
      options.filters.background_us = 1;
      break;
    case 1:
      options.filters.refractory_us = 1;
      break;
    case 2:
      options.balance.balance = true;
      break;
    case 3:
      options.smoothing.median = true;
      break;
    case 4:
      options.smoothing.blur_px = 0.5;
      break;
    case 5:
      options.range.range = Range::percentile;
      break;
    case 6:
      surroundings.hot_pixels = {{0, 0}};
      break;
    default:
      surroundings.camera = CameraCalibration{{}, 4.0, 4.0, 1.5, 1.0, {}, {}};
  }
  const Stepped stepped(options, surroundings);
  CHECK(stepped.outer.get() != stepped.inner);
  stepped.outer->observe({});
  CHECK(stepped.inner->observed == 1);
}

TEST_CASE("filters come in order, count what they remove, and later ones never see it") {
  StepOptions options;
  options.filters.refractory_us = 100;
  options.filters.background_us = 1000;
  StepSurroundings surroundings = plain();
  surroundings.corner = {10, 20};
  surroundings.hot_pixels = {{10, 20}, {2, 1}, {300, 300}};  // one in view, at 0,0
  const Stepped stepped(options, surroundings);
  stepped.outer->process(std::vector<Event>{
      {0, 0, 0, true},     // hot
      {1, 1, 1, true},     // no neighbour but the hot one: background
      {2, 1, 1, true},     // too soon
      {3, 2, 1, true},     // supported by 1,1, though that was removed itself
      {3, 0, 0, true},     // hot
      {1500, 2, 2, true},  // support was too long ago
  });
  CHECK(stepped.inner->taken == std::vector<Event>{{3, 2, 1, true}});
  CHECK(stepped.removed.hot_pixels == 2);
  CHECK(stepped.removed.refractory == 1);
  CHECK(stepped.removed.background == 2);
}

TEST_CASE("given weights stay with their events and are multiplied by the balance") {
  StepOptions options;
  options.balance = {.balance = true, .prior = 10.0, .ratio = 4.0, .cap = 63};
  StepSurroundings surroundings = plain();
  surroundings.hot_pixels = {{0, 0}};
  const Stepped stepped(options, surroundings);
  const std::vector<float> weights{1.0F, 2.0F, 3.0F};
  stepped.outer->process(std::vector<Event>{{0, 1, 0, true}, {0, 0, 0, true}, {0, 2, 0, false}}, weights);
  CHECK(stepped.inner->weights_taken == std::vector<float>{0.5F, 6.0F});
}

TEST_CASE("many events in one call are taken piece by piece, weights along with them") {
  StepOptions options;
  options.filters.refractory_us = 1;
  const Stepped stepped(options, plain());
  std::vector<Event> events;
  std::vector<float> weights;
  for (int i = 0; i < 10000; ++i) {
    events.push_back({i, static_cast<std::uint16_t>(i % 4), 0, true});
    weights.push_back(static_cast<float>(i));
  }
  stepped.outer->process(events, weights);
  CHECK(stepped.inner->taken == events);
  CHECK(stepped.inner->weights_taken == weights);
}

TEST_CASE("filtered events reach a method without weights") {
  StepOptions options;
  options.filters.refractory_us = 1;
  const Stepped stepped(options, plain());
  stepped.outer->process(std::vector<Event>{{0, 0, 0, true}});
  CHECK(stepped.inner->weights_taken.empty());
}

TEST_CASE("tone goes smoothing, range, undistortion, before levels are rounded") {
  StepOptions options;
  options.smoothing.blur_px = 0.6;
  options.range = {.range = Range::percentile, .low_percent = 0.0, .high_percent = 100.0};
  StepSurroundings surroundings = plain();
  surroundings.camera = CameraCalibration{{}, 4.0, 4.0, 1.5, 1.0, {}, {2.0}};
  const Stepped stepped(options, surroundings);
  stepped.outer->process(std::vector<Event>{{0, 1, 1, true}, {1, 1, 1, true}, {2, 2, 2, true}});
  cv::Mat1f expected = stepped.inner->sums.clone();
  Smoothing(options.smoothing).apply(expected);
  RangeStretch(options.range).apply(expected);
  Undistortion(*surroundings.camera, kSize).apply(expected);
  cv::Mat1f levels;
  stepped.outer->render_levels(3, levels);
  CHECK(cv::norm(levels, expected, cv::NORM_INF) == 0);
  cv::Mat1b grey;
  stepped.outer->render(3, grey);
  cv::Mat1b rounded;
  expected.convertTo(rounded, CV_8U);
  CHECK(cv::norm(grey, rounded, cv::NORM_INF) == 0);
}

TEST_CASE("percentiles in the wrong order are refused, chosen or not") {
  StepOptions options;
  options.range.low_percent = 100.0;
  CHECK_THROWS_AS(Stepped(options, plain()), Error);
}
