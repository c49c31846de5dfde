#include "esi/pipeline/sim_job.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "esi/core/error.hpp"
#include "esi/io/ground_truth.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

/// 0.1 s on a small sensor.
SimConfig tiny() {
  SimConfig config;
  config.set_json(nlohmann::json::parse(R"({"trajectory": "slide", "slide_mps": 2.0, "duration_s": 0.1,
    "height_m": 1.0, "sensor": "48x32", "exposure_ms": 10.0, "frame_period_ms": 30.0})"),
                  "tiny");
  return config;
}

}  // namespace

TEST_CASE("a printed simulation config reads back equal, and lists every option once") {
  SimConfig config = tiny();
  config.set("write=txt,h5");
  CHECK(config.output.formats() == std::vector<std::string>{"h5", "txt"});
  SimConfig copy;
  copy.set_json(config.json(), "printed");
  CHECK(copy.json() == config.json());
  std::size_t options = 0;
  for (const auto& group : config.groups()) options += group.table.options().size();
  CHECK(options == config.json().size());
}

TEST_CASE("a simulation is told how far it is, up to the end") {
  const test::TempFolder folder;
  std::vector<double> fractions;
  std::int64_t events = 0;
  const SimReport report = run_job({folder / "out", 1, "test"}, tiny(), [&](const Progress& p) {
    fractions.push_back(p.fraction.value());
    events = p.events;
    return true;
  });
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  REQUIRE_FALSE(fractions.empty());
  CHECK(fractions.back() == 1.0);
  CHECK(report.events == events);
  CHECK(report.intensity_frames == 4);
  CHECK(report.t_us == 100000);
  CHECK_FALSE(report.stopped);
  const GroundTruth truth = read_ground_truth(folder / "out" / "ground_truth.json");
  CHECK(truth.phases == std::vector<Phase>{{"slide", {0, 100000}}});
  CHECK(std::filesystem::exists(truth.corners));
}

TEST_CASE("an observer stops a simulation, which then does not claim to be complete") {
  const test::TempFolder folder;
  SimConfig config = tiny();
  config.set("duration_s=10");
  const SimReport report =
      run_job({folder / "out", 1, "test"}, config, [](const Progress&) { return false; });
  CHECK(report.stopped);
  CHECK(report.t_us < 1'000'000);
  CHECK_FALSE(std::filesystem::exists(folder / "out" / "run.json"));
  CHECK_FALSE(std::filesystem::exists(folder / "out" / "events.h5"));
}

TEST_CASE("a preview shows events on the left and the latest intensity frame on the right") {
  const test::TempFolder folder;
  SimConfig config = tiny();
  config.set("sensor=48x33");  // an odd height
  config.set("preview=true");
  run_job({folder / "out", 1, "test"}, config);
  cv::VideoCapture video((folder / "out" / "preview.mp4").string());
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; video.read(frame);) frames.push_back(frame.clone());
  REQUIRE(frames.size() == 3);  // at 0, 40 and 80 ms
  CHECK(frames[0].size() == cv::Size(96, 34));
  const auto spread = [&](const cv::Mat& frame, int x) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(frame(cv::Rect(x, 0, 48, 33)), mean, deviation);
    return std::pair(mean[0], deviation[0]);
  };
  CHECK(spread(frames[0], 0).first == Approx(128).margin(4));
  CHECK(spread(frames[0], 0).second < 4);
  CHECK(spread(frames[0], 48).first < 4);
  CHECK(spread(frames[1], 0).second > 20);
  CHECK(spread(frames[1], 48).second > 10);
}

TEST_CASE("poses come from a file, whose damage is told with its line") {
  const test::TempFolder folder;
  SimConfig config = tiny();
  const auto simulate = [&](const std::string& poses) {
    config.set("trajectory=poses");
    config.set("poses=" + folder.write("poses.tum", poses).string());
    config.set("force=true");
    return run_job({folder / "out", 1, "test"}, config);
  };
  // Looks down from 1 m above the board.
  CHECK(simulate("5.0 0 0 1.3 1 0 0 0\n5.05 0.1 0 1.3 1 0 0 0\n").t_us == 50000);
  CHECK_THROWS_WITH(simulate("5.0 0 0 1.3 1 0 0 0\n5.05 0.1 0 1.3 1 0\n"),
                    Contains("poses.tum: ") && Contains("line 2"));
  config.set("poses=nowhere.tum");
  CHECK_THROWS_WITH(run_job({folder / "out", 1, "test"}, config), Contains("nowhere.tum"));
}
