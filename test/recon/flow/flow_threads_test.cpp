// esi-flow on several threads: images are cut into pieces of rows, which must not show.

#include <catch2/catch.hpp>
#include <cstring>

#include "esi/recon/flow/esi_flow.hpp"
#include "support/random_events.hpp"

using namespace esi;
using namespace esi::test;

namespace {

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  REQUIRE(a.isContinuous());
  REQUIRE(b.isContinuous());
  return a.size() == b.size() && std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

/// Frames at the windows' ends and within them, and the motion at the end.
struct Shown {
  std::vector<cv::Mat1f> frames;
  cv::Mat2f motion;
};

/// Of random events, an event for every tenth pixel in a window. The first windows have more cycles, and
/// another way to the motion.
Shown shown_by(SensorSize size, int threads, std::int64_t levels = 4) {
  constexpr std::int64_t kWindows = 10;
  EsiFlowOptions options;
  options.first_windows = 2;
  options.first_cycles = 2;
  options.levels = levels;
  EsiFlow flow(options, size);
  if (threads > 1) flow.use_workers(std::make_shared<WorkerPool>(threads - 1));
  const int a_window = 1 + size.width_px * size.height_px / 10;
  Shown shown;
  for (std::int64_t k = 0; k < kWindows; ++k) {
    auto events = random_events({0, 0, size.width_px, size.height_px}, static_cast<std::size_t>(a_window), 0,
                                static_cast<unsigned>(k));
    for (std::size_t i = 0; i < events.size(); ++i)
      events[i].t_us = 10'000 * k + static_cast<std::int64_t>(i * 9'999 / events.size());
    flow.process(std::span(events).first(events.size() / 2));
    flow.render_levels(10'000 * k + 5'000, shown.frames.emplace_back());
    flow.process(std::span(events).subspan(events.size() / 2));
    flow.render_levels(10'000 * k + 10'000, shown.frames.emplace_back());
  }
  shown.motion = flow.motion()->clone();
  return shown;
}

}  // namespace

TEST_CASE("frames and motion have the same bytes on any number of threads") {
  // Two levels are cut, one, none; then an odd column, a single one (whose steps are taken one by one), a
  // row.
  for (const SensorSize size :
       {SensorSize{301, 203}, SensorSize{97, 131}, SensorSize{33, 17}, SensorSize{3, 6001},
        SensorSize{1, 9001}, SensorSize{9001, 1}, SensorSize{1, 1}}) {
    const Shown expected = shown_by(size, 1);
    for (const int threads : {2, 3, 7}) {
      INFO(size.width_px << "x" << size.height_px << ", " << threads << " threads");
      const Shown shown = shown_by(size, threads);
      for (std::size_t k = 0; k < shown.frames.size(); ++k) {
        INFO("frame " << k);
        CHECK(same_bytes(shown.frames[k], expected.frames[k]));
      }
      CHECK(same_bytes(shown.motion, expected.motion));
    }
  }
}

TEST_CASE("one level has the same bytes on any number of threads, too") {
  const SensorSize size{130, 127};
  const Shown expected = shown_by(size, 1, 1);
  CHECK(same_bytes(shown_by(size, 3, 1).frames.back(), expected.frames.back()));
}
