#include "esi/io/output/motion_folder.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/video/tracking.hpp>
#include <random>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Contains;

namespace {

cv::Mat2f random_motion(unsigned seed, int width = 13, int height = 7) {
  std::mt19937 random(seed);
  const auto any = [&random] { return static_cast<float>(static_cast<double>(random()) / 1e7 - 200.0); };
  cv::Mat2f motion(height, width);
  for (cv::Vec2f& v : motion) v = {any(), any()};
  return motion;
}

}  // namespace

TEST_CASE("OpenCV reads a field of motion as it was written") {
  const TempFolder folder;
  MotionFolder motion(folder / "flow", {}, "f1");
  motion.write(random_motion(1), 0);
  motion.write(random_motion(2), 1);
  motion.complete("{}");
  CHECK(names_in(folder / "flow") == std::vector<std::string>{"flow_0000000000.flo", "flow_0000000000.png",
                                                              "flow_0000000001.flo", "flow_0000000001.png",
                                                              "run.json"});
  const cv::Mat2f read = cv::readOpticalFlow((folder / "flow" / "flow_0000000001.flo").string());
  CHECK(read.size() == cv::Size(13, 7));
  CHECK(cv::norm(read, random_motion(2), cv::NORM_INF) == 0.0);
  CHECK(cv::imread((folder / "flow" / "flow_0000000001.png").string()).size() == cv::Size(13, 7));
}

TEST_CASE("a field of motion is little-endian behind its magic") {
  const cv::Mat2f motion(1, 2, cv::Vec2f(1.0F, -2.0F));
  using namespace std::string_literals;
  const std::string vector = "\0\0\x80\x3f\0\0\0\xc0"s;
  CHECK(flo_file(motion) == "PIEH\2\0\0\0\1\0\0\0"s + vector + vector);
}

TEST_CASE("in the picture hue is direction, and the faster the more of it") {
  cv::Mat2f motion(1, 5, cv::Vec2f(0.0F, 0.0F));
  motion(1) = {40.0F, 0.0F};
  motion(2) = {0.0F, 40.0F};
  motion(3) = {-40.0F, 0.0F};
  motion(4) = {20.0F, 0.0F};
  const cv::Mat3b picture = motion_picture(motion);
  CHECK(picture(0) == cv::Vec3b(255, 255, 255));
  CHECK(picture(1) == cv::Vec3b(0, 0, 255));                               // red, BGR
  CHECK(cv::norm(cv::Vec3i(picture(2)) - cv::Vec3i(0, 255, 128)) <= 1.0);  // 90 degrees: yellow-green
  CHECK(picture(3) == cv::Vec3b(255, 255, 0));                             // cyan
  CHECK(picture(4) == cv::Vec3b(128, 128, 255));
  // What is slower than 1 isn't blown up.
  CHECK(motion_picture(cv::Mat2f(1, 1, cv::Vec2f(0.1F, 0.0F)))(0) == cv::Vec3b(230, 230, 255));
}

TEST_CASE("fields of motion replace only fields of motion") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "flow");
  folder.write("flow/flow_0000000000.flo", "old");
  folder.write("flow/flow_0000000007.png", "old");
  CHECK_THROWS_WITH(MotionFolder(folder / "flow", {}, "f1"), Contains("not empty"));
  MotionFolder(folder / "flow", {.force = true}, "f1").write(random_motion(1), 0);
  CHECK_FALSE(std::filesystem::exists(folder / "flow" / "flow_0000000007.png"));
  CHECK_FALSE(std::filesystem::exists(folder / "flow" / "run.json"));
  for (const char* const other : {"flow_.flo", "flow_1.txt", "flow_x.png", "mine.flo"}) {
    const TempFolder with_other;
    std::filesystem::create_directory(with_other / "flow");
    with_other.write(std::string("flow/") + other, "mine");
    CHECK_THROWS_WITH(MotionFolder(with_other / "flow", {.force = true}, "f1"), Contains(other));
  }
}
