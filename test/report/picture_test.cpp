#include <catch2/catch.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "esi/report/svg_picture.hpp"

using namespace esi;

namespace {

cv::Mat decoded(const std::string& png) {
  return cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
}

/// Dark pixels of a text.
int ink(const std::string& text) {
  Svg svg(200, 30);
  svg.text({10, 20}, text);
  const cv::Mat picture = decoded(png_of(svg));
  cv::Mat grey;
  cv::extractChannel(picture, grey, 0);
  return cv::countNonZero(grey < 128);
}

}  // namespace

TEST_CASE("a drawing becomes a picture of twice its size, on white, with the colours where they are") {
  Svg svg(100, 50);
  svg.rectangle({20, 10}, 30, 20, "#ff0000");
  const cv::Mat picture = decoded(png_of(svg));
  REQUIRE(picture.size() == cv::Size(200, 100));
  REQUIRE(picture.channels() == 3);
  CHECK(picture.at<cv::Vec3b>(0, 0) == cv::Vec3b(255, 255, 255));
  CHECK(picture.at<cv::Vec3b>(40, 60) == cv::Vec3b(0, 0, 255));
  CHECK(picture.at<cv::Vec3b>(21, 41) == cv::Vec3b(0, 0, 255));
  CHECK(picture.at<cv::Vec3b>(18, 38) == cv::Vec3b(255, 255, 255));
  CHECK(picture.at<cv::Vec3b>(61, 101) == cv::Vec3b(255, 255, 255));
}

TEST_CASE("a picture has texts, and is the same every time") {
  CHECK(ink("x") > 20);
  CHECK(ink("xxxxxxxxxx") > 5 * ink("x"));
  Svg svg(100, 50);
  svg.text({10, 20}, "same");
  CHECK((png_of(svg) == png_of(svg)));
}

TEST_CASE("no name stops a picture, whatever bytes are in it") {
  for (const char* const name :
       {"\x01\x1f", "\xef\xbf\xbf", "\xef\xbf\xbe", "\xff\xfe", "a\nb\tc", "]]><!--&"}) {
    CAPTURE(name);
    CHECK_NOTHROW(ink(name));
  }
}

TEST_CASE("a huge drawing becomes a smaller picture") {
  CHECK(decoded(png_of(Svg(100'000, 100))).size() == cv::Size(32'000, 32));
  CHECK(decoded(png_of(Svg(10'000, 10'000))).total() <= 50'000'000);
}
