#include "esi/sim/simulator.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/core/json_text.hpp"
#include "support/shared_data.hpp"

using namespace esi;

namespace {

struct Recording {
  std::vector<Event> events;
  std::vector<EventCause> causes;
  std::vector<IntensityFrame> frames;
};

Recording record(Simulator& simulator) {
  Recording all;
  Packet packet;
  while (simulator.next(packet)) {
    REQUIRE(simulator.causes().size() == packet.events.size());
    all.events.insert(all.events.end(), packet.events.begin(), packet.events.end());
    all.causes.insert(all.causes.end(), simulator.causes().begin(), simulator.causes().end());
    all.frames.insert(all.frames.end(), packet.frames.begin(), packet.frames.end());
  }
  CHECK(packet.events.empty());
  CHECK(packet.frames.empty());
  return all;
}

Recording record(const SimOptions& options, int threads = 1) {
  Simulator simulator(options, threads);
  return record(simulator);
}

/// A flight on a sensor of 48 rows: three blocks.
SimOptions small_flight() {
  SimOptions options;
  options.trajectory.duration_s = 0.3;
  options.camera.scale = 0.3;
  options.camera.crop = "64x48";
  options.sensor.shot_hz = 6.0;
  options.sensor.hot_share = 0.01;
  options.frames.frame_period_ms = 50.0;
  options.frames.exposure_ms = 20.0;
  return options;
}

cv::Mat1d as_double(const cv::Mat& image) {
  cv::Mat1d result;
  image.convertTo(result, CV_64F);
  return result;
}

bool same_images(const std::vector<IntensityFrame>& a, const std::vector<IntensityFrame>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const IntensityFrame& p, const IntensityFrame& q) {
                      return p.exposure == q.exposure && cv::norm(p.image, q.image, cv::NORM_INF) == 0.0;
                    });
}

SimOptions without_noise(SimOptions options) {
  options.sensor.shot_hz = options.sensor.leak_hz = options.sensor.hot_share = options.sensor.mismatch = 0.0;
  options.sensor.random_start = false;
  options.frames.read_noise = 0.0;
  return options;
}

}  // namespace

TEST_CASE("The same seed gives the same events and frames on any number of threads") {
  const Recording one = record(small_flight(), 1);
  REQUIRE(one.events.size() > 1000);
  REQUIRE(one.frames.size() == 6);
  const int threads = GENERATE(1, 2, 5);
  const Recording many = record(small_flight(), threads);
  CHECK(one.events == many.events);
  CHECK(one.causes == many.causes);
  CHECK(same_images(one.frames, many.frames));
}

TEST_CASE("Events are sorted by time, then row, then column, and lie within the recording") {
  const Recording all = record(small_flight());
  const auto key = [](const Event& e) { return std::tuple(e.t_us, e.y, e.x); };
  CHECK(std::is_sorted(all.events.begin(), all.events.end(),
                       [&](const Event& a, const Event& b) { return key(a) < key(b); }));
  CHECK(all.events.front().t_us >= 0);
  CHECK(all.events.back().t_us < 300'000);
  for (const Event& event : all.events) REQUIRE(SensorSize{64, 48}.contains(event.x, event.y));
  for (const EventCause cause : {EventCause::signal, EventCause::shot, EventCause::hot}) {
    CHECK(std::count(all.causes.begin(), all.causes.end(), cause) > 10);
  }
}

TEST_CASE("Another seed gives other noise and the same truth; another scene seed gives another truth") {
  SimOptions options = small_flight();
  Simulator first(options, 1);
  options.seed = 2;
  Simulator second(options, 1);
  options.scene_seed = 2;
  Simulator third(options, 1);
  for (const std::int64_t t_us : {0, 123'456, 300'000}) {
    const auto a = first.scenario().clean_frame(t_us), b = second.scenario().clean_frame(t_us);
    CHECK(cv::norm(a, b, cv::NORM_INF) == 0.0);
    CHECK(first.scenario().tags(t_us)[0].corners == second.scenario().tags(t_us)[0].corners);
    CHECK(first.scenario().camera_pose(t_us).position_m == second.scenario().camera_pose(t_us).position_m);
    CHECK(cv::norm(a, third.scenario().clean_frame(t_us), cv::NORM_INF) > 10.0);
  }
  const Recording one = record(first), other = record(second);
  CHECK(one.events != other.events);
  CHECK_FALSE(same_images(one.frames, other.frames));
  const auto size = [](const Recording& r) { return static_cast<double>(r.events.size()); };
  CHECK(size(one) == Approx(size(other)).epsilon(0.05));
}

TEST_CASE("Without noise the seed changes nothing, and a standing camera sees nothing") {
  SimOptions options = without_noise(small_flight());
  const Recording one = record(options);
  options.seed = 2;
  CHECK(record(options).events == one.events);
  CHECK(std::count(one.causes.begin(), one.causes.end(), EventCause::signal) ==
        static_cast<std::ptrdiff_t>(one.events.size()));
  options.trajectory.kind = TrajectoryOptions::Kind::still;
  Simulator still(options, 1);
  const Recording nothing = record(still);
  CHECK(nothing.events.empty());
  CHECK(nothing.frames.size() == 6);
  CHECK(still.t_us() == 300'000);
}

TEST_CASE("Intensity frames are exposed when asked, blurred by the motion, and noisy as asked") {
  SimOptions options = without_noise(small_flight());
  options.frames.frame_period_ms = 100.0;
  options.frames.exposure_ms = 80.0;
  Simulator simulator(options, 1);
  const auto frames = record(simulator).frames;
  REQUIRE(frames.size() == 3);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::int64_t begin_us = 100'000 * static_cast<std::int64_t>(k);
    CHECK(frames[k].exposure == Interval{begin_us, begin_us + 80'000});
    // The mean of what was there to see.
    cv::Mat1d mean(48, 64, 0.0);
    for (int i = 0; i < 80; ++i)
      mean += as_double(simulator.scenario().clean_frame(begin_us + 1000 * i + 500)) / 80.0;
    CHECK(cv::norm(mean, as_double(frames[k].image), cv::NORM_INF) < 1.5);
  }
  const cv::Mat1d sharp = as_double(simulator.scenario().clean_frame(240'000));
  CHECK(cv::norm(sharp, as_double(frames[2].image), cv::NORM_INF) > 5.0);

  options.frames.read_noise = 4.0;
  const auto noisy = record(options).frames;
  double squares = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double distance = cv::norm(as_double(noisy[k].image), as_double(frames[k].image));
    squares += distance * distance;
  }
  CHECK(std::sqrt(squares / (3 * 64 * 48)) == Approx(4.0).margin(0.2));
}

TEST_CASE(
    "An exposure that would outlast the recording is not taken, and one longer than the period is refused") {
  SimOptions options = small_flight();
  options.frames.exposure_ms = 50.0;
  options.trajectory.duration_s = 0.099;
  CHECK(record(options).frames.size() == 1);
  options.frames.exposure_ms = 50.1;
  CHECK_THROWS_WITH(Simulator(options, 1), Catch::Contains("exposure_ms"));
}

TEST_CASE("Packets are small, whatever the recording's length") {
  SimOptions options = small_flight();
  options.trajectory.duration_s = GENERATE(0.5, 2.0);
  options.trajectory.kind = TrajectoryOptions::Kind::slide;
  options.sensor.shot_hz = 100.0;
  Simulator simulator(options, 1);
  Packet packet;
  std::size_t largest = 0, capacity = 0;
  while (simulator.next(packet)) {
    largest = std::max(largest, packet.events.size());
    capacity = packet.events.capacity();
    CHECK(packet.frames.size() <= 3);
  }
  CHECK(largest > kPacketEvents / 2);
  CHECK(largest < 2 * kPacketEvents);
  CHECK(capacity < 4 * kPacketEvents);
}

TEST_CASE("A crop simulates the same pixels as the whole sensor does") {
  SimOptions options = small_flight();
  options.sensor.mismatch = 0.05;
  options.trajectory.duration_s = 0.1;
  options.camera.crop = "";
  const Recording whole = record(options);
  options.camera.crop = "48x32";
  const Camera camera(options.camera);
  const Recording crop = record(options);
  std::vector<Event> inside;
  for (const Event& event : whole.events) {
    const int x = event.x - camera.origin_px[0], y = event.y - camera.origin_px[1];
    if (!camera.size.contains(x, y)) continue;
    inside.push_back({event.t_us, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), event.on});
  }
  // Steps may be cut elsewhere where the crop doesn't see the fastest motion, so a few events differ.
  REQUIRE(crop.events.size() > 300);
  std::size_t same = 0;
  for (const Event& event : crop.events) {
    same += std::any_of(inside.begin(), inside.end(), [&](const Event& e) {
      return e.x == event.x && e.y == event.y && e.on == event.on && std::abs(e.t_us - event.t_us) <= 20;
    });
  }
  CHECK(static_cast<double>(same) > 0.97 * static_cast<double>(crop.events.size()));
}

TEST_CASE("A crop larger than the sensor is refused") {
  SimOptions options;
  options.camera.crop = "400x200";
  CHECK_THROWS_WITH(Simulator(options, 1), Catch::Contains("crop"));
}

TEST_CASE("The presets are read back as they were written, and hold the numbers of their scene") {
  const auto [name, lux, shot_hz] =
      GENERATE(table<std::string, double, double>({{"indoor", 100, 0.5}, {"dim", 10, 6}, {"dark", 2, 12}}));
  const auto path = test::source_dir() / "configs" / "sim" / ("flight-" + name + ".json");
  std::ifstream file(path);
  REQUIRE(file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  SimOptions options;
  OptionTable table = table_of(options);
  const auto config = parse_json(text, path.string());
  table.set_json(config);
  CHECK(options.sensor.illuminance_lux == lux);
  CHECK(options.sensor.shot_hz == shot_hz);
  for (const auto& [key, value] : config.items()) CHECK(table.at(key).json() == value);
  CHECK_NOTHROW(options.sensor.check());
  CHECK_NOTHROW(options.frames.check());
}

TEST_CASE("Options that no simulation could follow are refused with their bounds") {
  SimOptions options;
  OptionTable table = table_of(options);
  for (const char* const assignment :
       {"step_us=1001", "max_motion_px=0.6", "threshold=0", "duration_s=0", "duration_s=1e9", "scale=0",
        "crop=0x0", "sensor=9000x10", "trajectory=loop", "shot_hz=-1", "shot_hz=nan", "seed=-1"}) {
    INFO(assignment);
    CHECK_THROWS_AS(table.set_assignment(assignment), Error);
  }
  CHECK_THROWS_WITH(table.set_assignment("shot_rate=1"), Catch::Contains("shot_hz"));
}
