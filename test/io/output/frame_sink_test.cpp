#include "esi/io/output/frame_sink.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using Catch::Contains;
using esi::open_frame_sink;
using esi::test::error_of;
using esi::test::TempFolder;

TEST_CASE("The form of the output's name says what is written") {
  struct Row {
    std::string name;
    std::string made;  ///< a file that only this kind of sink makes
  };
  const std::vector<Row> rows = {{"out", "out/timestamps.txt"},
                                 {"out/", "out/timestamps.txt"},
                                 {"v1.2", "v1.2/timestamps.txt"},
                                 {"folder.mp4", "folder.mp4/timestamps.txt"},
                                 {"a.mp4", "a.mp4.timestamps.txt"},
                                 {"a.MKV", "a.MKV.timestamps.txt"},
                                 {"b.c.avi", "b.c.avi.timestamps.txt"},
                                 {"new/deep.mp4/", "new/deep.mp4/timestamps.txt"},
                                 {"new/a.avi", "new/a.avi.timestamps.txt"}};
  for (const Row& row : rows) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "folder.mp4");
    const auto sink = open_frame_sink(folder / row.name, {}, {{32, 24}, 100, ""});
    sink->write(esi::test::frame_of(0, esi::test::noise(0, 32, 24)));
    sink->finish("{}");
    CHECK(std::filesystem::is_regular_file(folder / row.made));
  }
}

TEST_CASE("A name that says nothing is refused with what would") {
  const TempFolder folder;
  for (const std::string name : {"a.png", "a.webm", "b.c.MOV"}) {
    const auto error = error_of([&] { open_frame_sink(folder / name, {}, {{32, 24}, 100, ""}); });
    CHECK_THAT(error.what(), Contains(name) && Contains(".mkv, .mp4 or .avi") && Contains("a folder"));
    CHECK(error.kind() == esi::Error::Kind::usage);
  }
  CHECK(error_of([] { open_frame_sink("", {}, {}); }).kind() == esi::Error::Kind::usage);
  CHECK(error_of([] {
          open_frame_sink("-", {false, true, 1}, {{32, 24}, 100, ""});
        }).kind() == esi::Error::Kind::usage);
}

TEST_CASE("The options of a sink are declared with their bounds") {
  esi::SinkOptions options;
  esi::OptionTable table = esi::table_of(options);
  table.set_assignment("force=true");
  table.set_assignment("resume=true");
  table.set_assignment("png_compression=9");
  CHECK(options.force);
  CHECK(options.resume);
  CHECK(options.png_compression == 9);
  for (const char* const bad : {"png_compression=10", "png_compression=-1"}) {
    CHECK_THROWS_AS(table.set_assignment(bad), esi::Error);
  }
}
