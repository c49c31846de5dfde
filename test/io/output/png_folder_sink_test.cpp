#include <catch2/catch.hpp>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "io/output/png_folder.hpp"

using Catch::Contains;
using esi::PngFolderSink;
using namespace esi::test;
using namespace esi::test::png_folder;
using Names = std::vector<std::string>;

TEST_CASE("A finished folder holds the frames, their lists and the manifest, and nothing else") {
  const TempFolder folder;
  const auto out = folder / "new" / "out";
  const int threads = GENERATE(1, 3);
  PngFolderSink sink(out, {}, context(threads));
  const esi::Frame first{0, -1, 7, noise(0, kWidth, kHeight)};
  const esi::Frame second{1, 1234567890123, 0, noise(1, kWidth, kHeight)};
  sink.write(first);
  sink.write(second);
  sink.finish(kManifest);
  CHECK(names_in(out) == Names{"frame_0000000000.png", "frame_0000000001.png", "frames.csv", "images.txt",
                               "run.json", "timestamps.txt"});
  CHECK(content_of(out / "timestamps.txt") == "-0.000001000\n1234567.890123000\n");
  CHECK(content_of(out / "images.txt") ==
        "-0.000001000 frame_0000000000.png\n1234567.890123000 frame_0000000001.png\n");
  CHECK(content_of(out / "frames.csv") == "index,t_us,events_since_previous\n0,-1,7\n1,1234567890123,0\n");
  CHECK(content_of(out / "run.json") == kManifest);
  for (const esi::Frame& frame : {first, second}) {
    const cv::Mat image =
        cv::imread((out / esi::frame_file_name(frame.index)).string(), cv::IMREAD_UNCHANGED);
    REQUIRE(image.type() == CV_8UC1);
    CHECK(cv::norm(image, frame.grey, cv::NORM_INF) == 0);
  }
}

TEST_CASE("Any number of threads makes the same bytes, from a frame that its owner uses again") {
  const TempFolder folder;
  const auto run = [&](int threads) {
    const auto out = folder / std::to_string(threads);
    PngFolderSink sink(out, {}, context(threads));
    esi::Frame frame = made_frame(0);
    for (std::int64_t i = 0; i < 100; ++i) {
      frame.index = i;
      made_frame(i).grey.copyTo(frame.grey);
      sink.write(frame);
    }
    sink.finish(kManifest);
    return contents_of(out);
  };
  const auto expected = run(1);
  CHECK(expected.size() == 104);
  CHECK((run(2) == expected));
  CHECK((run(5) == expected));
}

TEST_CASE("Nothing claims to be complete before finish, or without it") {
  const TempFolder folder;
  const int threads = GENERATE(1, 3);
  {
    PngFolderSink sink(folder.path(), {}, context(threads));
    write_frames(sink, 3);
    CHECK_FALSE(std::filesystem::exists(folder / "run.json"));
    CHECK_FALSE(std::filesystem::exists(folder / "timestamps.txt"));
    CHECK(content_of(folder / ".esi-incomplete") == "{\"fingerprint\":\"f1\"}\n");
  }
  for (const std::string& name : names_in(folder.path())) {
    CHECK((name == ".esi-incomplete" || (name.starts_with("frame_") && name.ends_with(".png"))));
  }
}

TEST_CASE("A run that is stopped keeps its frames and lists, without the mark of completeness") {
  const TempFolder folder;
  const int threads = GENERATE(1, 4);
  PngFolderSink sink(folder.path(), {}, context(threads));
  write_frames(sink, 2);
  sink.stop();
  CHECK(names_in(folder.path()) == Names{".esi-incomplete", "frame_0000000000.png", "frame_0000000001.png",
                                         "frames.csv", "images.txt", "timestamps.txt"});
  CHECK(content_of(folder / "timestamps.txt") == "0.010000000\n0.020000000\n");
}

TEST_CASE("A place that cannot become a folder is refused") {
  const TempFolder folder;
  const auto file = folder.write("file", "");
  const auto taken = error_of([&] { PngFolderSink(file, kForce, context()); });
  CHECK_THAT(taken.what(), Contains("is a file"));
  CHECK(taken.kind() == esi::Error::Kind::usage);
  const auto read_only = error_of(
      [&] { PngFolderSink(std::filesystem::path(esi::test::kReadOnlyFolder) / "out", {}, context()); });
  CHECK_THAT(read_only.what(), Contains("/sys/out") && Contains("cannot be created"));
  CHECK(read_only.kind() == esi::Error::Kind::failure);
}

TEST_CASE("When the disk is full, what is kept is whole and without a gap") {
  const TempFolder folder;
  const int threads = GENERATE(1, 2, 5);
  PngFolderSink sink(folder.path(), {}, context(threads));
  // Flat frames are small enough for the limit, noise isn't.
  const auto grey = [](std::int64_t i) {
    return i == 30 ? noise(i, kWidth, kHeight) : cv::Mat1b(kHeight, kWidth, static_cast<std::uint8_t>(i));
  };
  std::string message;
  {
    const esi::test::FileSizeLimit limit(400);
    message = error_of([&] {
                for (std::int64_t i = 0; i < 60; ++i) sink.write(frame_of(i, grey(i)));
              }).what();
    CHECK_THROWS_AS(sink.write(frame_of(60, grey(60))), esi::Error);
    CHECK_THROWS_AS(sink.finish(kManifest), esi::Error);
  }
  sink.stop();
  CHECK_THAT(message, Contains("frame_0000000030.png") && Contains("File too large"));
  const Names names = names_in(folder.path());
  CHECK(names.size() == 30 + 4);
  CHECK(names[30] == "frame_0000000029.png");
  CHECK_FALSE(std::filesystem::exists(folder / "run.json"));
  const std::string timestamps = content_of(folder / "timestamps.txt");
  CHECK(std::count(timestamps.begin(), timestamps.end(), '\n') == 30);
}

TEST_CASE("An error that stop() meets is not lost") {
  const TempFolder folder;
  {
    PngFolderSink sink(folder.path(), {}, context());
    write_frames(sink, 1);
  }
  PngFolderSink resumed(folder.path(), kResume, context(3));
  const esi::test::FileSizeLimit limit(400);
  write_frames(resumed, 2);  // the first is there, and so not written
  CHECK_THROWS_WITH(resumed.stop(), Contains("frame_0000000001.png"));
  CHECK(content_of(folder / "timestamps.txt") == "0.010000000\n");
}

TEST_CASE("A folder that vanishes while a run writes into it is an error") {
  const TempFolder folder;
  const int threads = GENERATE(1, 3);
  PngFolderSink sink(folder / "out", {}, context(threads));
  sink.write(made_frame(0));
  std::filesystem::remove_all(folder / "out");
  const auto error = error_of([&] {
    for (std::int64_t i = 1; i < 20; ++i) sink.write(made_frame(i));
  });
  CHECK_THAT(error.what(), Contains("frame_00000000") && Contains("No such file"));
}

TEST_CASE("A folder takes frames only in turn and of the right size") {
  const TempFolder folder;
  PngFolderSink sink(folder.path(), {}, context());
  CHECK_THROWS_WITH(sink.write(made_frame(1)), Contains("frame 0"));
  CHECK_THROWS_WITH(sink.write(frame_of(0, noise(0, 3, 2))), Contains("3x2"));
}
