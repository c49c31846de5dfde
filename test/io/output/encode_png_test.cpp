#include "esi/io/output/encode_png.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "io/output/sink_fixtures.hpp"
#include "support/temp_folder.hpp"

using esi::encode_png;
using esi::test::noise;

namespace {

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

TEST_CASE("A PNG keeps every grey level, at every size and compression") {
  const cv::Size size = GENERATE(cv::Size(1, 1), cv::Size(1, 300), cv::Size(300, 1), cv::Size(347, 261));
  const int level = GENERATE(0, 1, 2, 6, 9);
  for (const cv::Mat1b& grey : {noise(0, size.width, size.height), cv::Mat1b(size, 128)}) {
    const std::vector<std::uint8_t> png = encode_png(grey, level);
    const cv::Mat decoded = cv::imdecode(png, cv::IMREAD_UNCHANGED);
    REQUIRE(decoded.type() == CV_8UC1);
    REQUIRE(decoded.size() == size);
    CHECK(cv::norm(decoded, grey, cv::NORM_INF) == 0);
  }
}

TEST_CASE("A part of a larger image is encoded as an image of its own") {
  const cv::Mat1b part = noise(0, 40, 30)(cv::Rect(3, 5, 20, 10));
  CHECK(encode_png(part, 1) == encode_png(part.clone(), 1));
}

TEST_CASE("Compression makes a flat image small, and level 0 does not") {
  const cv::Mat1b flat(100, 100, std::uint8_t{7});
  CHECK(encode_png(flat, 0).size() > 10000);
  CHECK(encode_png(flat, 1).size() < 1000);
  CHECK(encode_png(flat, 9).size() < 1000);
}

TEST_CASE("An image without pixels is refused") { CHECK_THROWS_AS(encode_png({}, 1), esi::Error); }

TEST_CASE("A PNG file counts as whole only to its last byte and with the right size") {
  const esi::test::TempFolder folder;
  const std::string png = as_text(encode_png(noise(0, 30, 20), 1));
  const auto path = folder.write("a.png", png);
  CHECK(esi::is_whole_png(path, {30, 20}));
  CHECK_FALSE(esi::is_whole_png(path, {20, 30}));
  for (const std::size_t size : {png.size() - 1, png.size() / 2, std::size_t{20}, std::size_t{0}}) {
    CHECK_FALSE(esi::is_whole_png(folder.write("cut.png", png.substr(0, size)), {30, 20}));
  }
  CHECK_FALSE(esi::is_whole_png(folder.write("zeros.png", std::string(png.size(), '\0')), {30, 20}));
  CHECK_FALSE(esi::is_whole_png(folder / "none.png", {30, 20}));
}
