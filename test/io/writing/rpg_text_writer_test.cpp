#include <opencv2/imgcodecs.hpp>

#include "io/writing/writer_fixtures.hpp"

using esi::test::content_of;
using esi::test::names_in;
using esi::test::TempFolder;
using Names = std::vector<std::string>;

TEST_CASE("RPG text is seconds with six decimals, x, y and polarity") {
  const TempFolder folder;
  const std::vector<esi::Event> events = {
      {-1000001, 0, 0, false},    {-1, 345, 259, true}, {0, 1, 2, true},
      {7, 10, 20, false},         {999999, 1, 1, true}, {1000000, 1, 1, true},
      {123456789012, 1, 1, false}};
  esi::test::write_recording(folder / "events.txt", {events, {}});
  CHECK(content_of(folder / "events.txt") ==
        "-1.000001 0 0 0\n-0.000001 345 259 1\n0.000000 1 2 1\n0.000007 10 20 0\n0.999999 1 1 1\n"
        "1.000000 1 1 1\n123456.789012 1 1 0\n");
}

TEST_CASE("Frames stand beside RPG text as pictures, listed at the middle of their exposures") {
  const TempFolder folder;
  const auto frames = esi::test::noise_frames(0, 3);
  esi::test::write_recording(folder / "events.txt", {{{5, 1, 1, true}}, frames},
                             {esi::test::kSensor, 2'000'000, ""});
  CHECK(names_in(folder.path()) == Names{"events.txt", "images", "images.txt"});
  CHECK(content_of(folder / "images.txt") ==
        "2.005000000 images/frame_00000000.png\n2.045000000 images/frame_00000001.png\n"
        "2.085000000 images/frame_00000002.png\n");
  REQUIRE(names_in(folder / "images") ==
          Names{"frame_00000000.png", "frame_00000001.png", "frame_00000002.png"});
  for (std::size_t i = 0; i < 3; ++i) {
    const cv::Mat image =
        cv::imread((folder / "images" / names_in(folder / "images")[i]).string(), cv::IMREAD_UNCHANGED);
    REQUIRE(image.type() == CV_8UC1);
    CHECK(cv::norm(image, frames[i].image, cv::NORM_INF) == 0);
  }
}

TEST_CASE("Pictures that a killed run left half written don't become part of a recording") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "images.part");
  folder.write("images.part/frame_00000009.png", "old");
  esi::test::write_recording(folder / "events.txt", {{}, esi::test::noise_frames(0, 1)});
  CHECK(names_in(folder.path()) == Names{"events.txt", "images", "images.txt"});
  CHECK(names_in(folder / "images") == Names{"frame_00000000.png"});
}

TEST_CASE("Pictures whose events cannot be put in place are taken back") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "out");
  const auto writer = esi::open_recording_writer(folder / "out" / "events.txt", esi::test::kWriteOptions);
  esi::Packet packet;
  packet.frames = esi::test::noise_frames(0, 2);
  writer->write(packet);
  std::filesystem::create_directory(folder / "out" / "events.txt");
  CHECK_THROWS_AS(writer->finish(), esi::Error);
  CHECK(names_in(folder / "out") == Names{"events.txt", "events.txt.part"});
}
