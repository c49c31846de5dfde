#include "esi/pipeline/reconstruct.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/event_gate.hpp"
#include "esi/pipeline/crop.hpp"
#include "support/scripted_reader.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

// Writes down what it is given: the image's pixel is the number of events so far.
class Recorder final : public Reconstructor {
 public:
  void observe(const IntensityFrame& frame) override {
    observed.push_back({frame.exposure.end_us, count, rendered});
  }
  void render(std::int64_t t_us, cv::Mat1b& grey) override {
    CHECK(t_last_us < t_us);
    ++rendered;
    grey.create(1, 1);
    grey(0, 0) = static_cast<unsigned char>(count);
  }
  void render_levels(std::int64_t /*t_us*/, cv::Mat1f& /*levels*/) override { FAIL("the loop wants images"); }

  struct Observation {
    std::int64_t t_us;
    int events_before;
    int frames_before;
    friend bool operator==(const Observation&, const Observation&) = default;
  };
  std::int64_t t_last_us = INT64_MIN;
  int count = 0;
  int rendered = 0;
  std::vector<Observation> observed;

 private:
  void take(std::span<const Event> events, std::span<const float> weights) override {
    CHECK(weights.empty());
    for (const Event& event : events) t_last_us = event.t_us;
    count += static_cast<int>(events.size());
  }
};

class FrameList final : public FrameSink {
 public:
  void write(const Frame& frame) override {
    frames.push_back(frame);
    frames.back().grey = frame.grey.clone();
  }
  void finish(const std::string&) override {}
  void stop() override {}

  std::vector<Frame> frames;
};

std::unique_ptr<EventSource> source_of(std::vector<Packet> packets) {
  ReadOptions options;
  options.size = "10x10";
  return std::make_unique<EventGate>(std::make_unique<ScriptedReader>(std::move(packets)), options, "rec");
}

std::vector<Event> one_event_each_ms(int n) {
  std::vector<Event> events;
  for (int i = 0; i < n; ++i) events.push_back({i * 1000, static_cast<std::uint16_t>(i % 10), 5, true});
  return events;
}

}  // namespace

TEST_CASE("every frame shows the events before it, however the recording is cut into packets") {
  const auto packet_size = GENERATE(1u, 7u, 10u, 1000u);
  const auto source = source_of(packets_of(one_event_each_ms(35), packet_size));
  FixedRate schedule(100, 0);
  Recorder method;
  FrameList sink;
  const Reconstruction result = reconstruct(*source, schedule, method, sink, 100, "rec", {});
  REQUIRE(sink.frames.size() == 4);
  CHECK(result.frames == 4);
  CHECK(result.digest.events() == 35);
  const int shown[] = {10, 20, 30, 35};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(sink.frames[k].index == static_cast<std::int64_t>(k));
    CHECK(sink.frames[k].t_us == static_cast<std::int64_t>(k + 1) * 10000);
    CHECK(sink.frames[k].grey(0, 0) == shown[k]);
    CHECK(sink.frames[k].events_since_previous == (k < 3 ? 10 : 5));
  }
}

TEST_CASE("intensity frames reach the method at their exposures' ends, however the recording is cut") {
  const auto packet_size = GENERATE(1u, 7u, 10u, 1000u);
  auto packets = packets_of(one_event_each_ms(35), packet_size);
  packets.front().frames = {{{0, 4500}, cv::Mat1b(1, 1)}, {{5000, 10000}, cv::Mat1b(1, 1)}};
  for (const std::int64_t end_us : {34500, 60000}) {
    packets.back().frames.push_back({{5000, end_us}, cv::Mat1b(1, 1)});
  }
  const auto source = source_of(packets);
  FixedRate schedule(100, 0);
  Recorder method;
  FrameList sink;
  reconstruct(*source, schedule, method, sink, 100, "rec", {});
  // The one that ends with the first frame is part of it; what ends behind the last frame comes too late.
  const std::vector<Recorder::Observation> expected = {{4500, 5, 0}, {10000, 10, 0}, {34500, 35, 3}};
  CHECK(method.observed == expected);
}

TEST_CASE("at intensity frames' own pace, each frame shows the events before the exposure's end, and it") {
  const auto packet_size = GENERATE(1u, 7u, 10u, 1000u);
  auto packets = packets_of(one_event_each_ms(35), packet_size);
  packets.front().frames = {{{0, 4500}, cv::Mat1b(1, 1)}, {{5000, 10000}, cv::Mat1b(1, 1)}};
  packets.back().frames = packet_size == 1000u ? packets.front().frames : std::vector<IntensityFrame>{};
  packets.back().frames.push_back({{5000, 60000}, cv::Mat1b(1, 1)});  // behind the last event
  const auto source = source_of(packets);
  AtIntensityFrames schedule;
  Recorder method;
  FrameList sink;
  const auto result = reconstruct(*source, schedule, method, sink, 100, "rec", {});
  CHECK(result.intensity_frames == 3);
  const std::vector<Recorder::Observation> expected = {{4500, 5, 0}, {10000, 10, 1}, {60000, 35, 2}};
  CHECK(method.observed == expected);
  REQUIRE(sink.frames.size() == 3);
  const std::int64_t t_us[] = {4500, 10000, 60000};
  const int shown[] = {5, 10, 35};
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(sink.frames[k].t_us == t_us[k]);
    CHECK(sink.frames[k].grey(0, 0) == shown[k]);
  }
}

TEST_CASE("a gap gives its frames, and one that would flood the disk is refused before") {
  const std::vector<Event> events = {{0, 1, 1, true}, {1000000, 1, 1, true}};
  FixedRate schedule(100, 0);
  Recorder method;
  FrameList sink;
  reconstruct(*source_of(packets_of(events, 1)), schedule, method, sink, 101, "rec", {});
  CHECK(sink.frames.size() == 101);

  FixedRate flooded(100, 0);
  FrameList none;
  CHECK_THROWS_WITH(reconstruct(*source_of(packets_of(events, 2)), flooded, method, none, 100, "rec", {}),
                    Contains("100 frames would be due") && Contains("--max-frames"));
  CHECK(none.frames.empty());
}

TEST_CASE("the observer can stop a reconstruction") {
  const auto source = source_of(packets_of(one_event_each_ms(1000), 50));
  FixedRate schedule(100, 0);
  Recorder method;
  FrameList sink;
  int calls = 0;
  const auto result =
      reconstruct(*source, schedule, method, sink, 1000, "rec", [&](const Progress& progress) {
        CHECK(progress.frames == static_cast<std::int64_t>(sink.frames.size()));
        return ++calls < 5;
      });
  CHECK(result.stopped);
  CHECK(calls == 5);
  CHECK(sink.frames.size() < 30);
}

TEST_CASE("a crop in time has frames up to its end, counted from its start") {
  CropSource source(source_of(packets_of(one_event_each_ms(100), 7)), {20000, 55000}, std::nullopt);
  FixedRate schedule(100, 20000);
  Recorder method;
  FrameList sink;
  const auto result = reconstruct(source, schedule, method, sink, 100, "rec", {});
  CHECK(result.digest.events() == 35);
  REQUIRE(sink.frames.size() == 4);
  CHECK(sink.frames[0].t_us == 30000);
  CHECK(sink.frames[0].events_since_previous == 10);
  CHECK(sink.frames[3].t_us == 60000);
}

TEST_CASE("a crop that ends in silence still has its frames") {
  const std::vector<Event> events = {{0, 1, 1, true}, {1000, 1, 1, true}, {900000, 1, 1, true}};
  CropSource source(source_of(packets_of(events, 1)), {0, 500000}, std::nullopt);
  FixedRate schedule(100, 0);
  Recorder method;
  FrameList sink;
  reconstruct(source, schedule, method, sink, 1000, "rec", {});
  CHECK(sink.frames.size() == 50);
}

TEST_CASE("how much has been read counts up to a crop's end, not the recording's") {
  CropSource source(source_of(packets_of(one_event_each_ms(100), 5)), {20000, 40000}, std::nullopt);
  Packet packet;
  std::vector<double> fractions;
  while (source.next(packet)) fractions.push_back(source.fraction_read().value());
  REQUIRE(fractions.size() >= 3);
  CHECK(fractions.front() >= 0.5);
  CHECK(fractions.front() < 0.7);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(source.fraction_read() == 1.0);
  CropSource whole(source_of(packets_of(one_event_each_ms(10), 5)), {}, std::nullopt);
  CHECK(whole.next(packet));
  CHECK_FALSE(whole.fraction_read());  // as its source, which can't tell
}

TEST_CASE("a region of interest moves its corner to the origin") {
  CropSource source(source_of(packets_of(one_event_each_ms(20), 7)), {}, Region{4, 5, {3, 2}});
  const Packet all = drain(source);
  CHECK(source.sensor_size() == SensorSize{3, 2});
  REQUIRE(all.events.size() == 6);
  CHECK(all.events[0] == Event{4000, 0, 0, true});
  CHECK(all.events[2] == Event{6000, 2, 0, true});
  CHECK(all.events[3].t_us == 14000);
  CHECK_THROWS_WITH(CropSource(source_of({}), {}, Region{8, 0, {3, 2}}), Contains("beyond the sensor"));
}

TEST_CASE("a region is read from X,Y,WxH and nothing else") {
  CHECK(parse_region("40,20,128x96") == Region{40, 20, {128, 96}});
  const auto bad = GENERATE("", "40", "40,20", "40,20,", "40,20,128", "-1,0,5x5", "1,2,3,4", "a,b,5x5");
  CHECK_THROWS_AS(parse_region(bad), Error);
}
