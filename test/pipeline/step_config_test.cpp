#include "esi/pipeline/step_config.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/recon_job.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kSensor{12, 10};

/// Every pixel fires twice in 1 s, and 3,4 a hundred times.
std::string recording_with_hot_pixel() {
  std::string text = "12 10\n";
  for (int i = 0; i < 240; ++i) {
    text += fmt::format("{:.6f} {} {} {}\n", i * 0.004, i % 12, i / 12 % 10, i % 2);
    if (i % 12 < 5) text += fmt::format("{:.6f} 3 4 1\n", i * 0.004);
  }
  return text;
}

ReadOptions from_file() {
  ReadOptions options;
  options.time_zero = TimeZero::file;
  return options;
}

nlohmann::json run_json(const test::TempFolder& folder,
                        const std::vector<std::pair<const char*, const char*>>& set,
                        const std::string& roi = {}) {
  ReconConfig config;
  config.read = from_file();
  config.sink.force = true;
  config.frames.roi = roi;
  OptionTable table = table_of(config.steps);
  for (const auto& [name, value] : set) table.at(name).set_text(value);
  const auto file = folder.write("events.txt", recording_with_hot_pixel());
  const ReconReport report = run_job({file, folder / "out", 1, "test"}, config);
  CHECK_FALSE(report.losses.any());
  return parse_json(read_text_file(folder / "out" / "run.json"), "run.json");
}

}  // namespace

TEST_CASE("hot pixels are learnt from the whole recording, and removing them is no loss") {
  const test::TempFolder folder;
  const auto json = run_json(folder, {{"hot_pixels", "learn"}});
  CHECK(json["steps"]["hot_pixels"] == "3,4");
  CHECK(json["steps"]["removed"] == nlohmann::json{{"hot_pixels", 102}});
  CHECK(json["config"]["hot_pixels"] == "learn");
  CHECK(json["events"]["used"] == 340);
}

TEST_CASE("hot pixels keep the sensor's coordinates in a region of interest") {
  const test::TempFolder folder;
  const auto json = run_json(folder, {{"hot_pixels", "3,4 11,9"}}, "2,3,5x5");
  CHECK(json["steps"]["removed"]["hot_pixels"] == 102);
  const auto learnt = run_json(folder, {{"hot_pixels", "learn"}}, "2,3,5x5");
  CHECK(learnt["steps"]["removed"]["hot_pixels"] == 102);
}

TEST_CASE("every chosen filter counts in run.json, others don't") {
  const test::TempFolder folder;
  CHECK(run_json(folder, {})["steps"] == nlohmann::json{{"removed", nlohmann::json::object()}});
  const auto json = run_json(folder, {{"background_us", "100"}, {"refractory_us", "5000"}});
  CHECK(json["steps"]["removed"]["background"] > 0);
  CHECK(json["steps"]["removed"]["refractory"] > 0);
  CHECK_FALSE(json["steps"]["removed"].contains("hot_pixels"));
}

TEST_CASE("what can't be is refused before anything is written") {
  const test::TempFolder folder;
  StepConfig config;
  config.steps.filters.hot_pixels = "learn";
  CHECK_THROWS_WITH(surroundings_of(config, "-", {}, kSensor, {}), Contains("standard input"));
  config.steps.filters.hot_pixels = "12,0";
  CHECK_THROWS_WITH(surroundings_of(config, "-", {}, kSensor, {}), Contains("12,0") && Contains("12x10"));
  config.steps.filters.hot_pixels.clear();
  config.undistort = folder.write("calib.txt", "9 9 20 5 0 0 0 0 0").string();
  CHECK_THROWS_WITH(surroundings_of(config, "-", {}, kSensor, {}), Contains("calib.txt"));
  config.undistort = (folder / "absent").string();
  CHECK_THROWS_AS(surroundings_of(config, "-", {}, kSensor, {}), Error);
  config.steps.range.low_percent = 100.0;
  CHECK_THROWS_WITH(config.check(), Contains("low_percent"));
}

TEST_CASE("a region of interest is undistorted as its part of the sensor") {
  const test::TempFolder folder;
  StepConfig config;
  config.undistort = folder.write("calib.txt", "9 9 6 5 0.1 0 0 0 0").string();
  const StepSurroundings whole = surroundings_of(config, "-", {}, kSensor, {});
  CHECK(whole.size == kSensor);
  CHECK(whole.corner == cv::Point(0, 0));
  REQUIRE(whole.camera);
  CHECK(whole.camera->cx == 6.0);
  const StepSurroundings part = surroundings_of(config, "-", {}, kSensor, Region{7, 6, {3, 2}});
  CHECK(part.size == SensorSize{3, 2});
  CHECK(part.corner == cv::Point(7, 6));
}

TEST_CASE("steps are options of the config, and of its JSON") {
  ReconConfig config;
  config.set_json({{"blur_px", 0.5}, {"range", "percentile"}, {"hot_pixels", "1,2"}, {"balance", true}}, "a");
  CHECK(config.steps.steps.smoothing.blur_px == 0.5);
  ReconConfig copy;
  copy.set_json(config.json(), "b");
  CHECK(copy.json() == config.json());
  CHECK(copy.steps.steps.balance.balance);
}
