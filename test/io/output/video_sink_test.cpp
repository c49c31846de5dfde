#include "esi/io/output/video_sink.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using Catch::Contains;
using esi::VideoSink;
using esi::test::content_of;
using esi::test::error_of;
using esi::test::frame_of;
using esi::test::names_in;
using esi::test::noise;
using esi::test::TempFolder;
using Names = std::vector<std::string>;

namespace {

constexpr int kWidth = 346, kHeight = 260;
constexpr esi::SinkOptions kForce{true, false, 1}, kResume{false, true, 1};

esi::SinkContext context(const std::string& fingerprint = "f1", double fps = 100) {
  return {{kWidth, kHeight}, fps, fingerprint};
}

/// All 256 grey levels, smooth enough for any codec, with one bright block that tells the frames apart.
cv::Mat1b ramp(std::int64_t index) {
  cv::Mat1b grey(kHeight, kWidth);
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) grey(y, x) = static_cast<std::uint8_t>(std::min(x * 256 / 346, 255));
  }
  grey(cv::Rect(static_cast<int>(index) * 24, 96, 24, 24)) = 255;
  return grey;
}

void write_video(const std::filesystem::path& path, const std::vector<cv::Mat1b>& frames,
                 const esi::SinkOptions& options = {}) {
  VideoSink sink(path, options, context());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sink.write(frame_of(static_cast<std::int64_t>(i), frames[i]));
  }
  sink.finish("{\"fingerprint\":\"f1\"}");
}

std::vector<cv::Mat1b> decoded(const std::filesystem::path& path) {
  cv::VideoCapture capture(path.string(), cv::CAP_FFMPEG);
  std::vector<cv::Mat1b> frames;
  for (cv::Mat bgr, grey; capture.read(bgr);) {
    cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
    frames.emplace_back(grey.clone());
  }
  return frames;
}

double mean_difference(const cv::Mat1b& a, const cv::Mat1b& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

}  // namespace

TEST_CASE("FFV1 keeps every grey level of every pixel") {
  const TempFolder folder;
  std::vector<cv::Mat1b> frames;
  for (int i = 0; i < 5; ++i) {
    frames.push_back(ramp(i));
    frames.push_back(noise(i, kWidth, kHeight));
  }
  write_video(folder / "a.mkv", frames);
  const auto found = decoded(folder / "a.mkv");
  REQUIRE(found.size() == frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) CHECK(cv::norm(found[i], frames[i], cv::NORM_INF) == 0);
}

TEST_CASE("Each kind of video holds all frames at their size and rate, with its lists beside it") {
  const TempFolder folder;
  const std::string name = GENERATE("a.mkv", "a.mp4", "a.avi", "B c: 5%d \xc3\xa9.MP4");
  write_video(folder / name, {ramp(0), ramp(5), ramp(10)});
  CHECK(names_in(folder.path()) == Names{name, name + ".run.json", name + ".timestamps.txt"});
  CHECK(content_of(folder / (name + ".run.json")) == "{\"fingerprint\":\"f1\"}");
  CHECK(content_of(folder / (name + ".timestamps.txt")) == "0.010000000\n0.020000000\n0.030000000\n");
  CHECK(cv::VideoCapture((folder / name).string(), cv::CAP_FFMPEG).get(cv::CAP_PROP_FPS) == Approx(100));
  const auto found = decoded(folder / name);
  REQUIRE(found.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(found[i].size() == cv::Size(kWidth, kHeight));
    CHECK(mean_difference(found[i], ramp(static_cast<std::int64_t>(i) * 5)) < 2.5);
    CHECK(mean_difference(found[i], ramp(static_cast<std::int64_t>(i) * 5)) <
          mean_difference(found[i], ramp(static_cast<std::int64_t>(i) * 5 + 2)));
  }
}

TEST_CASE("A video that could not be written to its last byte never gets its name") {
  const std::string name = GENERATE("a.mkv", "a.mp4", "a.avi");
  std::vector<cv::Mat1b> frames;
  frames.reserve(4);
  for (int i = 0; i < 4; ++i) frames.push_back(noise(i, kWidth, kHeight));
  const TempFolder whole;
  write_video(whole / name, frames);
  const std::size_t size = std::filesystem::file_size(whole / name);
  for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, size / 4, size / 2, size - 20000,
                                  size - 2000, size - 100, size - 1, size}) {
    const TempFolder folder;
    const esi::test::FileSizeLimit full(limit);
    INFO(name << ", cut at " << limit << " of " << size);
    if (limit < size) {
      CHECK_THROWS_WITH(write_video(folder / name, frames), Contains((folder / name).string()));
      CHECK(names_in(folder.path()).empty());
    } else {
      CHECK_NOTHROW(write_video(folder / name, frames));
    }
  }
}

TEST_CASE("A video that cannot be made is refused before anything is written") {
  const auto context_of = [](esi::SensorSize size) {
    esi::SinkContext sized = context();
    sized.size = size;
    return sized;
  };
  struct Row {
    std::string name;
    esi::SinkOptions options;
    esi::SinkContext context;
    std::string message;
  };
  const std::vector<Row> rows = {
      {"a.webm", {}, context(), ".mkv, .mp4 or .avi"},
      {"old.mkv", {}, context(), "--force"},
      {"old.mkv", kResume, context(), "already complete"},
      {"old.mkv", kResume, context("f2"), "cannot be resumed"},
      {"orphan.mkv", {}, context(), "orphan.mkv.run.json"},
      {"a.mkv", {}, context_of({345, 260}), "even width"},
      {"a.mkv", {}, context_of({346, 261}), "even width"},
      {"a.mkv", {}, context_of({0, 0}), "even width"},
      {"a.mkv", {}, context("", 0), "frames per second"},
      {"a.mkv", {}, context("", std::nan("")), "frames per second"},
      {"a.mkv", {}, context("", 0.009), "frames per second"},
      {"a.mkv", {}, context("", 1001), "frames per second"},
  };
  const TempFolder folder;
  folder.write("old.mkv", "video");
  folder.write("old.mkv.run.json", "{\"fingerprint\":\"f1\"}");
  folder.write("orphan.mkv.run.json", "{}");
  const Names before = names_in(folder.path());
  for (const Row& row : rows) {
    const auto error = error_of([&] { VideoSink(folder / row.name, row.options, row.context); });
    CHECK_THAT(error.what(), Contains(row.name) && Contains(row.message));
    CHECK(error.kind() == esi::Error::Kind::usage);
    CHECK(names_in(folder.path()) == before);
  }
  const auto read_only = std::filesystem::path(esi::test::kReadOnlyFolder) / "new" / "a.mkv";
  CHECK_THROWS_WITH(VideoSink(read_only, {}, context()), Contains("/sys/new: cannot be created"));
}

TEST_CASE("A codec that cannot be opened is named") {
  const TempFolder folder;
  const auto error = error_of([&] { VideoSink(folder / "a.mp4", {}, {{20000, 2}, 100, ""}); });
  CHECK_THAT(error.what(), Contains("a.mp4") && Contains("mp4v"));
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("Force replaces a video only once the new one is whole") {
  const TempFolder folder;
  write_video(folder / "a.mkv", {ramp(1)});
  const std::string old = content_of(folder / "a.mkv");
  {
    VideoSink sink(folder / "a.mkv", kForce, context());
    sink.write(frame_of(0, ramp(2)));
    CHECK(content_of(folder / "a.mkv") == old);
  }
  CHECK(names_in(folder.path()) == Names{"a.mkv", "a.mkv.run.json", "a.mkv.timestamps.txt"});
  CHECK(content_of(folder / "a.mkv") == old);
  write_video(folder / "a.mkv", {ramp(2), ramp(3)}, kForce);
  CHECK(decoded(folder / "a.mkv").size() == 2);
}

TEST_CASE("A video that is stopped keeps its frames, without the mark of completeness") {
  const TempFolder folder;
  write_video(folder / "a.mkv", {ramp(1)});
  VideoSink sink(folder / "a.mkv", kForce, context());
  sink.write(frame_of(0, ramp(2)));
  sink.write(frame_of(1, ramp(3)));
  sink.stop();
  CHECK(names_in(folder.path()) == Names{"a.mkv", "a.mkv.timestamps.txt"});
  CHECK(decoded(folder / "a.mkv").size() == 2);
}

TEST_CASE("A video without frames leaves nothing") {
  const TempFolder folder;
  {
    VideoSink sink(folder / "a.mkv", {}, context());
    CHECK_THROWS_WITH(sink.finish("{}"), Contains("no frames"));
  }
  VideoSink(folder / "a.mkv", {}, context()).stop();
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("Two runs cannot write one video at a time") {
  const TempFolder folder;
  auto first = std::make_unique<VideoSink>(folder / "a.mkv", esi::SinkOptions{}, context());
  CHECK_THROWS_WITH(VideoSink(folder / "a.mkv", {}, context()), Contains("another run"));
  first->write(frame_of(0, ramp(0)));
  first->finish("{}");
  VideoSink second(folder / "a.mkv", kForce, context());
  first.reset();  // must not take away what the second writes
  second.write(frame_of(0, ramp(0)));
  second.finish("{}");
  CHECK(names_in(folder.path()) == Names{"a.mkv", "a.mkv.run.json", "a.mkv.timestamps.txt"});
}

TEST_CASE("The remains of a killed run don't matter, and go") {
  const TempFolder folder;
  folder.write(".a.part.mkv", "remains");
  { const VideoSink sink(folder / "a.mkv", {}, context()); }
  CHECK(names_in(folder.path()).empty());
  folder.write(".a.part.mkv", std::string(1000000, 'x'));
  write_video(folder / "a.mkv", {ramp(0)});
  CHECK(names_in(folder.path()) == Names{"a.mkv", "a.mkv.run.json", "a.mkv.timestamps.txt"});
}

TEST_CASE("A relative name with a colon is a file, not a protocol") {
  const TempFolder folder;
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  CHECK_NOTHROW(write_video("rec:1.mkv", {ramp(0)}));
  std::filesystem::current_path(old);
  CHECK(std::filesystem::exists(folder / "rec:1.mkv"));
}

TEST_CASE("A video takes frames only in turn and of the right size") {
  const TempFolder folder;
  VideoSink sink(folder / "a.mkv", {}, context());
  CHECK_THROWS_WITH(sink.write(frame_of(1, ramp(1))), Contains("frame 0"));
  CHECK_THROWS_WITH(sink.write(frame_of(0, noise(0, 4, 2))), Contains("4x2"));
}
