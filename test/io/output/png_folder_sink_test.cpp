#include "esi/io/output/png_folder_sink.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using Catch::Contains;
using esi::PngFolderSink;
using esi::test::content_of;
using esi::test::error_of;
using esi::test::frame_of;
using esi::test::names_in;
using esi::test::noise;
using esi::test::TempFolder;
using Names = std::vector<std::string>;

namespace {

constexpr int kWidth = 32, kHeight = 24;
constexpr const char* kManifest = "{\"fingerprint\": \"f1\"}\n";

esi::SinkContext context(int threads = 1, const std::string& fingerprint = "f1") {
  return {{kWidth, kHeight}, 100, threads, fingerprint};
}

esi::Frame made_frame(std::int64_t index) { return frame_of(index, noise(index, kWidth, kHeight)); }

void write_frames(esi::FrameSink& sink, std::int64_t end) {
  for (std::int64_t i = 0; i < end; ++i) sink.write(made_frame(i));
}

void write_run(const std::filesystem::path& folder, std::int64_t frames, const esi::SinkOptions& options = {},
               int threads = 1) {
  PngFolderSink sink(folder, options, context(threads));
  write_frames(sink, frames);
  sink.finish(kManifest);
}

std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const std::string& name : names_in(folder)) contents[name] = content_of(folder / name);
  return contents;
}

ino_t file_number(const std::filesystem::path& path) {
  struct stat found {};
  REQUIRE(::stat(path.c_str(), &found) == 0);
  return found.st_ino;
}

constexpr esi::SinkOptions kForce{true, false, 1}, kResume{false, true, 1};

}  // namespace

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

TEST_CASE("A resumed run ends like one that was never interrupted, and writes only what was missing") {
  const TempFolder folder;
  const int threads = GENERATE(1, 3);
  write_run(folder / "whole", 20);
  const auto out = folder / "out";
  {
    PngFolderSink sink(out, {}, context());
    write_frames(sink, 10);
  }  // as if killed
  std::filesystem::remove(out / "frame_0000000003.png");
  std::filesystem::resize_file(out / "frame_0000000005.png", 500);
  folder.write("out/frame_0000000004.png.part", "half");
  folder.write("out/frame_0000000020.png", "of a longer run");
  folder.write("out/frame_0000000777.png", "of a longer run");
  const ino_t kept = file_number(out / "frame_0000000009.png");
  write_run(out, 20, kResume, threads);
  std::filesystem::remove(out / "frame_0000000004.png.part");
  CHECK((contents_of(out) == contents_of(folder / "whole")));
  CHECK(file_number(out / "frame_0000000009.png") == kept);
}

TEST_CASE("Resuming what was never begun is a run from the start") {
  const TempFolder folder;
  write_run(folder / "out", 2, kResume);
  CHECK(std::filesystem::exists(folder / "out" / "run.json"));
}

TEST_CASE("A resumed run that is stopped early keeps the frames of the first") {
  const TempFolder folder;
  {
    PngFolderSink sink(folder.path(), {}, context());
    write_frames(sink, 6);
  }
  std::filesystem::remove(folder / "frame_0000000004.png");
  PngFolderSink sink(folder.path(), kResume, context());
  write_frames(sink, 2);
  sink.stop();
  // 5 is behind a gap.
  CHECK(names_in(folder.path()) == Names{".esi-incomplete", "frame_0000000000.png", "frame_0000000001.png",
                                         "frame_0000000002.png", "frame_0000000003.png", "frames.csv",
                                         "images.txt", "timestamps.txt"});
}

TEST_CASE("A folder that is in use is refused, and stays as it is") {
  struct Row {
    std::vector<std::pair<std::string, std::string>> files;
    esi::SinkOptions options;
    std::vector<std::string> message;
  };
  const std::string same = "{\"fingerprint\":\"f1\"}", other = "{\"fingerprint\":\"f2\"}";
  const std::string frame = "frame_0000000000.png";
  const std::vector<Row> rows = {
      {{{"letter.doc", ""}}, {}, {"not empty", "--force", "--resume"}},
      {{{frame, ""}, {".esi-incomplete", same}}, {}, {"not empty", "--force", "--resume"}},
      {{{"letter.doc", ""}, {"run.json", same}}, kForce, {"letter.doc"}},
      {{{"frame_0000000000.png.bak", ""}}, kForce, {"frame_0000000000.png.bak"}},
      {{{"frame_0000000000x.png", ""}}, kForce, {"frame_0000000000x.png"}},
      {{{"frame_1.png", ""}}, kForce, {"frame_1.png"}},
      {{{"frames.csv/photo.jpg", ""}}, kForce, {"frames.csv"}},
      {{{frame, ""}}, kResume, {"no run", "--force"}},
      {{{frame, ""}, {".esi-incomplete", ""}}, kResume, {"no run", "--force"}},
      {{{frame, ""}, {".esi-incomplete", "[1]"}}, kResume, {"no run", "--force"}},
      {{{frame, ""}, {".esi-incomplete", other}}, kResume, {"another input or other options"}},
      {{{frame, ""}, {"run.json", other}}, kResume, {"complete", "another input"}},
      {{{frame, ""}, {"run.json", same}}, kResume, {"already complete", "--force"}},
      {{{frame, ""}}, {true, true, 1}, {"--force and --resume"}},
  };
  for (const Row& row : rows) {
    const TempFolder folder;
    for (const auto& [name, content] : row.files) {
      std::filesystem::create_directories((folder / name).parent_path());
      folder.write(name, content);
    }
    const Names before = names_in(folder.path());
    const auto error = error_of([&] { PngFolderSink(folder.path(), row.options, context()); });
    for (const std::string& part : row.message) CHECK_THAT(error.what(), Contains(part));
    CHECK(error.kind() == esi::Error::Kind::usage);
    CHECK(names_in(folder.path()) == before);
  }
}

TEST_CASE("That a folder is complete already can be told from other errors") {
  const TempFolder folder;
  write_run(folder.path(), 1);
  CHECK_THROWS_AS(PngFolderSink(folder.path(), kResume, context()), esi::AlreadyComplete);
}

TEST_CASE("Force replaces all of a reconstruction") {
  const TempFolder folder;
  write_run(folder / "new", 2);
  write_run(folder / "out", 5);
  folder.write("out/frame_0000000009.png.part", "half");
  write_run(folder / "out", 2, kForce);
  CHECK((contents_of(folder / "out") == contents_of(folder / "new")));
}

TEST_CASE("Force takes the old mark of completeness away at once") {
  const TempFolder folder;
  write_run(folder.path(), 5);
  { const PngFolderSink sink(folder.path(), kForce, context()); }
  CHECK(names_in(folder.path()) == Names{".esi-incomplete"});
}

TEST_CASE("Two runs cannot write into one folder") {
  const TempFolder folder;
  const auto options = GENERATE(esi::SinkOptions{}, kForce, kResume);
  auto first = std::make_unique<PngFolderSink>(folder.path(), esi::SinkOptions{}, context());
  // With and without a frame there, which alone makes the folder count as not empty.
  CHECK_THROWS_WITH(PngFolderSink(folder.path(), options, context()),
                    Contains("another run") || Contains("not empty"));
  first->write(made_frame(0));
  CHECK_THROWS_WITH(PngFolderSink(folder.path(), options, context()),
                    Contains("another run") || Contains("not empty"));
  CHECK(std::filesystem::exists(folder / "frame_0000000000.png"));
  first->finish(kManifest);
  CHECK(contents_of(folder.path()).size() == 5);
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
