#include "esi/pipeline/evaluation/judged_frames.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "esi/pipeline/evaluation/timed_reconstructor.hpp"
#include "eval/tag_picture.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

/// Frame i shows tag i where it is asked for, else nothing; 10 ms apart.
struct Scene {
  EvalConfig config;
  LoadedTruth truth;
  std::vector<cv::Mat1b> greys;

  Scene() { truth.truth.phases = {{"a", {0, 1'000'000}}}; }

  void add(bool has_tag) {
    const int id = static_cast<int>(greys.size());
    greys.push_back(has_tag ? test::tag_picture("tag36h11", id, 5, {90, 80}, {15, 15}).grey
                            : cv::Mat1b(80, 90, std::uint8_t{90}));
  }

  MethodRun judged(int workers, std::size_t at_once = 4) const {
    WorkerPool pool(workers);
    DetectorPool detectors(config.detector);
    JudgedFrames frames(config, truth, pool, detectors, at_once);
    for (std::size_t i = 0; i < greys.size(); ++i) frames.write(frame(i));
    frames.finish("");
    return std::move(frames.run());
  }

  Frame frame(std::size_t i) const {
    Frame frame;
    frame.index = static_cast<std::int64_t>(i);
    frame.t_us = 10'000 * frame.index;
    frame.grey = greys[i];
    return frame;
  }
};

}  // namespace

TEST_CASE("frames come out in their order, on any number of threads") {
  Scene scene;
  for (int i = 0; i < 30; ++i) scene.add(i % 3 != 1);
  const int workers = GENERATE(0, 1, 3);
  const MethodRun run = scene.judged(workers);
  REQUIRE(run.frames.size() == 30);
  CHECK(run.detection_ms.size() == 30);
  for (int i = 0; i < 30; ++i) {
    const FrameDetections& frame = run.frames[static_cast<std::size_t>(i)];
    CHECK(frame.index == i);
    CHECK(frame.t_us == 10'000 * i);
    REQUIRE(frame.detections.size() == (i % 3 != 1 ? 1 : 0));
    if (i % 3 != 1) CHECK(frame.detections[0].id == i);
    CHECK(run.detection_ms[static_cast<std::size_t>(i)] > 0.0);
  }
}

TEST_CASE("of every so many frames one is judged, from the first on") {
  Scene scene;
  for (int i = 0; i < 7; ++i) scene.add(true);
  scene.config.judging.stride = 3;
  const MethodRun run = scene.judged(1);
  REQUIRE(run.frames.size() == 3);
  CHECK(run.frames[1].index == 3);
  CHECK(run.frames[2].detections.at(0).id == 6);
}

TEST_CASE("a writer's picture may change as soon as it is written") {
  Scene scene;
  for (int i = 0; i < 6; ++i) scene.add(true);
  WorkerPool pool(2);
  DetectorPool detectors(scene.config.detector);
  JudgedFrames frames(scene.config, scene.truth, pool, detectors, 6);
  cv::Mat1b shared;
  for (std::size_t i = 0; i < 6; ++i) {
    Frame frame = scene.frame(i);
    frame.grey.copyTo(shared);
    frame.grey = shared;
    frames.write(frame);
    shared.setTo(0);
  }
  frames.finish("");
  for (const FrameDetections& frame : frames.run().frames) CHECK(frame.detections.size() == 1);
}

TEST_CASE("of each phase the detected and the missed frame nearest to its middle are kept") {
  Scene scene;
  for (int i = 0; i < 20; ++i) scene.add(i == 2 || i == 3 || i == 18);
  scene.truth.truth.phases = {{"a", {0, 100'000}}, {"b", {100'000, 200'000}}};
  const MethodRun run = scene.judged(1);
  REQUIRE(run.samples.size() == 4);
  const auto time_of = [&](std::size_t phase, bool is_detected) {
    for (const SampleFrame& sample : run.samples) {
      if (sample.phase == phase && sample.is_detected == is_detected) return sample.t_us;
    }
    return std::int64_t{-1};
  };
  CHECK(time_of(0, true) == 30'000);
  CHECK(time_of(0, false) == 50'000);
  CHECK(time_of(1, true) == 180'000);
  CHECK(time_of(1, false) == 150'000);
  for (const SampleFrame& sample : run.samples) {
    CHECK(cv::countNonZero(sample.grey != scene.greys[static_cast<std::size_t>(sample.t_us / 10'000)]) == 0);
  }
}

TEST_CASE("a frame whose tags are not those of the truth is kept as missed") {
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.add(true);
  scene.truth.expected.ids = {1};
  const MethodRun run = scene.judged(0);
  REQUIRE(run.samples.size() == 2);
  for (const SampleFrame& sample : run.samples) CHECK(sample.is_detected == (sample.t_us == 10'000));
}

TEST_CASE("no more frames wait in memory than are allowed") {
  Scene scene;
  for (int i = 0; i < 9; ++i) scene.add(false);
  WorkerPool pool(1);
  DetectorPool detectors(scene.config.detector);
  JudgedFrames frames(scene.config, scene.truth, pool, detectors, 2);
  for (std::size_t i = 0; i < 9; ++i) {
    frames.write(scene.frame(i));
    CHECK(frames.run().frames.size() + 2 >= i + 1);
  }
}

TEST_CASE("frames are compared with the clean one of their time, where there is one") {
  const test::TempFolder folder;
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.add(i < 2);
  cv::imwrite((folder / "same.png").string(), scene.greys[1]);
  scene.truth.clean_frames[10'400] = folder / "same.png";
  const MethodRun run = scene.judged(1);
  REQUIRE(run.quality.size() == 1);
  CHECK(run.quality[0].t_us == 10'000);
  CHECK(run.quality[0].quality->ssim == Approx(1.0));
  CHECK(run.quality[0].sharpness);
}

TEST_CASE("what fails in a frame's task is told, with the file, and nothing hangs") {
  const test::TempFolder folder;
  Scene scene;
  for (int i = 0; i < 8; ++i) scene.add(i < 2);
  cv::imwrite((folder / "small.png").string(), cv::Mat(20, 30, CV_8UC1, cv::Scalar(3)));
  folder.write("no.png", "no picture");
  const auto [name, told] = GENERATE(std::pair{"small.png", "30x20"}, std::pair{"no.png", "not a picture"},
                                     std::pair{"absent.png", "absent.png"});
  scene.truth.clean_frames[30'000] = folder / name;
  const int workers = GENERATE(0, 2);
  CHECK_THROWS_WITH(scene.judged(workers, 2), Contains(name) && Contains(told));
}

namespace {

/// Takes some processor time for everything.
class Busy final : public Reconstructor {
 public:
  void observe(const IntensityFrame& /*frame*/) override { spend(2e-3); }
  void render_levels(std::int64_t /*t_us*/, cv::Mat1f& levels) override {
    levels.create(2, 2);
    levels = 77.0F;
    spend(1e-3);
  }

 private:
  void take(std::span<const Event> /*events*/, std::span<const float> /*weights*/) override { spend(3e-3); }
  static void spend(double seconds) {
    for (const double end_s = thread_cpu_s() + seconds; thread_cpu_s() < end_s;) continue;
  }
};

}  // namespace

TEST_CASE("all that a method does up to a frame counts for that frame") {
  Busy busy;
  TimedReconstructor timed(busy);
  const std::vector<Event> events(5);
  timed.process(events);
  timed.process(events);
  timed.observe({});
  cv::Mat1b grey;
  timed.render(0, grey);
  cv::Mat1f levels;
  timed.render_levels(1, levels);
  CHECK(grey(0, 0) == 77);
  CHECK(levels(1, 1) == 77.0F);
  CHECK(timed.events() == 10);
  REQUIRE(timed.frame_ms().size() == 2);
  CHECK(timed.frame_ms()[0] >= 9.0);
  CHECK(timed.frame_ms()[0] < 30.0);
  CHECK(timed.frame_ms()[1] >= 1.0);
  CHECK(timed.frame_ms()[1] < 9.0);
}
