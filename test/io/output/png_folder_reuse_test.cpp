// Folders that are not empty: resumed, replaced or refused.
#include <catch2/catch.hpp>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "io/output/png_folder.hpp"

using Catch::Contains;
using esi::PngFolderSink;
using namespace esi::test;
using namespace esi::test::png_folder;
using Names = std::vector<std::string>;

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
