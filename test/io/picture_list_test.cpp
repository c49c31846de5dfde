#include "esi/io/picture_list.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using test::TempFolder;

namespace {

void write_picture(const std::filesystem::path& path, int grey) {
  REQUIRE(cv::imwrite(path.string(), cv::Mat1b(4, 6, static_cast<std::uint8_t>(grey))));
}

}  // namespace

TEST_CASE("frames are found by images.txt, in order of time, or by timestamps.txt and their names") {
  const TempFolder folder;
  write_picture(folder / "b.png", 20);
  write_picture(folder / "a.png", 10);
  folder.write("timestamps.txt", "0.010000000\n0.020000000\n");
  auto frames = list_frames(folder.path());
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].t_us == 10000);
  CHECK(frames[0].file == folder / "a.png");
  CHECK(frames[1].file == folder / "b.png");

  folder.write("images.txt", "# time file\n0.5 b.png\r\n\n0.25 a.png\n");
  frames = list_frames(folder.path());
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].t_us == 250000);
  CHECK(read_picture(frames[0].file)(2, 3) == 10);
  CHECK(read_picture(frames[1].file)(2, 3) == 20);
}

TEST_CASE("a folder whose frames have no times, or too few, is refused") {
  const TempFolder folder;
  write_picture(folder / "a.png", 10);
  CHECK_THROWS_WITH(list_frames(folder.path()), Contains("neither images.txt nor timestamps.txt"));
  folder.write("timestamps.txt", "0.1\n0.2\n");
  CHECK_THROWS_WITH(list_frames(folder.path()), Contains("2 times for 1 PNG"));
  folder.write("images.txt", "0.1 a.png\n0.2 b.png\n");
  CHECK_THROWS_WITH(list_frames(folder.path()), Contains("b.png") && Contains("not there"));
  folder.write("images.txt", "0.1 a.png\nsoon b.png\n");
  CHECK_THROWS_WITH(list_frames(folder.path()), Contains("line 2"));
  folder.write("images.txt", "# nothing\n");
  CHECK_THROWS_WITH(list_frames(folder.path()), Contains("empty"));
}

TEST_CASE("what is no picture is said to be none") {
  const TempFolder folder;
  const auto text = folder.write("a.png", "text");
  CHECK_THROWS_WITH(read_picture(text), Contains("a.png") && Contains("not a picture"));
  CHECK_THROWS_WITH(read_picture(folder / "none.png"), Contains("none.png"));
}
