#include "esi/recon/network.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/recon/voxel_grid.hpp"
#include "support/random_events.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

constexpr SensorSize kSize{20, 12};

std::string tiny_network() { return (test::source_dir() / "test" / "models" / "tiny_network.onnx").string(); }

std::string content_of(const std::string& path) { return test::content_of(path); }

/// Plain: no post-processing, so that a level is 255 times what the network gave.
NetworkOptions options() {
  NetworkOptions options;
  options.model = tiny_network();
  options.window = NetworkOptions::Window::time;
  options.window_us = 1000;
  options.unsharp = 0.0;
  return options;
}

cv::Mat1f levels_of(Reconstructor& network, std::int64_t t_us) {
  cv::Mat1f levels;
  network.render_levels(t_us, levels);
  return levels.clone();
}

/// What the network gives for these windows of events, step by step, without Network.
cv::Mat1f levels_after(const std::vector<std::vector<Event>>& windows) {
  const Padding padding = Padding::to_multiple(kSize, 16);
  NetworkModel model(content_of(tiny_network()), "tiny", 16, 32);
  cv::Mat grid;
  cv::Mat padded;
  cv::Mat1f image;
  for (const auto& events : windows) {
    fill_voxel_grid(events, {}, 5, kSize, grid);
    normalise_non_zero(grid);
    pad_reflected(grid, padding, padded);
    image = model.run(padded);
  }
  cv::Mat1f levels;
  without_padding(image, padding).convertTo(levels, CV_32F, 255.0);
  return levels;
}

bool are_equal(const cv::Mat1f& a, const cv::Mat1f& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) < 1e-3;
}

}  // namespace

TEST_CASE("network: a frame shows the windows that have ended, and no event from its time on") {
  const std::vector<Event> events = test::random_events({0, 0, 20, 12}, 300, 10, 1);
  const auto part = [&](std::int64_t from_us, std::int64_t to_us) {
    std::vector<Event> some;
    for (const Event& event : events) {
      if (event.t_us >= from_us && event.t_us < to_us) some.push_back(event);
    }
    return some;
  };
  Network network(options(), kSize, content_of);
  CHECK(are_equal(levels_of(network, 0), cv::Mat1f(12, 20, kMidGrey)));
  network.process(part(0, 999));
  CHECK(are_equal(levels_of(network, 999), cv::Mat1f(12, 20, kMidGrey)));
  network.process(part(999, 1000));
  const cv::Mat1f first = levels_after({part(0, 1000)});
  CHECK(are_equal(levels_of(network, 1000), first));
  CHECK(are_equal(levels_of(network, 1000), first));  // asking again changes nothing
  network.process(part(1000, 1500));
  CHECK(are_equal(levels_of(network, 1500), first));
  network.process(part(1500, 2000));
  const cv::Mat1f second = levels_after({part(0, 1000), part(1000, 2000)});
  CHECK_FALSE(are_equal(first, second));
  CHECK(are_equal(levels_of(network, 2000), second));
  CHECK(are_equal(levels_of(network, 900000), second));  // empty windows leave everything as it is
}

TEST_CASE("network: windows by count hold events_per_pixel times the pixels") {
  const std::vector<Event> events = test::random_events({0, 0, 20, 12}, 84 + 84 + 83, 10, 2);
  NetworkOptions by_count = options();
  by_count.window = NetworkOptions::Window::events;
  by_count.events_per_pixel = 0.3541;  // 84.98 events
  Network network(by_count, kSize, content_of);
  network.process(events);
  const auto begin = events.begin();
  const std::vector<std::vector<Event>> windows{{begin, begin + 84}, {begin + 84, begin + 168}};
  CHECK(are_equal(levels_of(network, events.back().t_us + 1), levels_after(windows)));
}

TEST_CASE("network: options change what they say") {
  const std::vector<Event> events = test::random_events({0, 0, 20, 12}, 300, 10, 3);
  const auto levels_with = [&](auto change) {
    NetworkOptions changed = options();
    change(changed);
    Network network(changed, kSize, content_of);
    network.process(events);
    return levels_of(network, 100000);
  };
  const cv::Mat1f plain = levels_with([](NetworkOptions&) {});
  CHECK_FALSE(are_equal(plain, levels_with([](NetworkOptions& o) { o.normalise = false; })));
  CHECK_FALSE(are_equal(plain, levels_with([](NetworkOptions& o) { o.unsharp = 0.3; })));
  const cv::Mat1f stretched =
      levels_with([](NetworkOptions& o) { o.range = NetworkOptions::Range::percentiles; });
  cv::Mat1f expected;
  levels_between(plain, percentile(plain, 1.0), percentile(plain, 99.0), expected);
  CHECK(are_equal(stretched, expected));
  // 10 px on the left instead of 6: what is mirrored there differs, the middle doesn't.
  const cv::Mat1f padded = levels_with([](NetworkOptions& o) { o.pad_multiple = 40; });
  const cv::Rect middle(2, 2, 16, 8);
  CHECK(are_equal(plain(middle), padded(middle)));
}

TEST_CASE("network: weights scale what events add to the voxel grid") {
  const std::vector<Event> events = test::random_events({0, 0, 20, 12}, 300, 10, 4);
  NetworkOptions raw = options();
  raw.normalise = false;
  const auto contrast_with = [&](float weight) {
    Network network(raw, kSize, content_of);
    network.process(events, std::vector<float>(events.size(), weight));
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(levels_of(network, 100000), mean, deviation);
    return deviation[0];
  };
  CHECK(contrast_with(0.5F) < 0.8 * contrast_with(1.0F));
  CHECK(contrast_with(0.0F) < 1e-3);
}

TEST_CASE("network: without a model, or with a bad one, a person learns what to do") {
  CHECK_THROWS_WITH(Network({}, kSize, content_of),
                    Contains("scripts/export_onnx") && Contains("--set model="));
  try {
    Network({}, kSize, content_of);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::usage);
  }
  CHECK_THROWS_WITH(Network(options(), kSize, {}), Contains("tiny_network.onnx"));
  CHECK_THROWS_WITH(Network(options(), kSize, [](const std::string&) { return std::string("text"); }),
                    Contains("tiny_network.onnx: ") && Contains("no ONNX model"));
}
