#include "esi/eval/tag_detector.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "esi/eval/tag_families.hpp"
#include "eval/tag_picture.hpp"

using namespace esi;
using Catch::Contains;
using esi::test::tag_picture;

namespace {

DetectorOptions with(const std::string& assignment) {
  DetectorOptions options;
  table_of(options).set_assignment(assignment);
  return options;
}

double largest_error_px(const Detection& detection, const std::array<double, 8>& corners_px) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 8; ++k) {
    largest = std::max(largest, std::abs(detection.xy_px[k] - corners_px[k]));
  }
  return largest;
}

}  // namespace

TEST_CASE("Tags of every family are found where they were drawn, corners in the order of the truth") {
  for (const std::string& family : tag_family_names()) {
    INFO(family);
    const TagFamilyInfo info = tag_family_info(family);
    const int id = info.id_count - 1;
    const auto picture = tag_picture(family, id, 8);
    DetectorOptions options = with("family=" + family);
    options.quad_decimate = 1.0;
    options.refine_edges = false;  // it moves them, see below
    TagDetector detector(options);
    const std::vector<Detection> found = detector.detect(picture.grey);
    REQUIRE(found.size() == 1);
    CHECK(found[0].id == id);
    CHECK(found[0].hamming == 0);
    CHECK(found[0].margin > 50.0);
    CHECK(largest_error_px(found[0], picture.corners_px) < 0.1);
    CHECK(std::abs(found[0].centre.x - (picture.corners_px[0] + picture.corners_px[2]) / 2.0) < 0.1);
    CHECK(std::abs(found[0].centre.y - (picture.corners_px[1] + picture.corners_px[5]) / 2.0) < 0.1);
  }
}

TEST_CASE("Refined edges of crisp tags lie an eighth of a pixel to the upper left at half size") {
  const auto picture = tag_picture("tag36h11", 0, 8);
  const Detection full = TagDetector().detect(picture.grey).at(0);
  CHECK(largest_error_px(full, picture.corners_px) < 0.2);
  const Detection found = TagDetector(with("quad_decimate=2")).detect(picture.grey).at(0);
  for (std::size_t k = 0; k < 8; ++k)
    CHECK(found.xy_px[k] - picture.corners_px[k] == Approx(-0.125).margin(0.05));
}

TEST_CASE("What is said of the families is what the library has") {
  REQUIRE(tag_family_names().size() == 9);
  for (const std::string& family : tag_family_names()) {
    INFO(family);
    const TagFamily library = make_tag_family(family);
    CHECK(library->name == family);
    CHECK(tag_family_info(family).id_count == static_cast<int>(library->ncodes));
    CHECK(tag_family_info(family).bits == static_cast<int>(library->nbits));
  }
}

TEST_CASE("Ids of the truth must be of the family") {
  CHECK_NOTHROW(require_tag_ids("tag36h11", std::vector{0, 586}));
  CHECK_THROWS_WITH(require_tag_ids("tag36h11", std::vector{0, 587}),
                    "there is no tag 587 in tag36h11, whose ids are 0 to 586");
  CHECK_THROWS_WITH(require_tag_ids("tag16h5", std::vector{-1}), Contains("-1"));
  CHECK_THROWS_WITH(require_tag_ids("tag36h12", {}), Contains("nearest is tag36h1") && Contains("tag16h5"));
}

TEST_CASE("Several tags come by id, those of one id from left to right, in any run") {
  const cv::Size size{400, 200};
  cv::Mat1b grey = tag_picture("tag36h11", 5, 8, size, {300, 60}).grey;
  tag_picture("tag36h11", 3, 8, size, {200, 50})
      .grey(cv::Rect(195, 0, 100, 200))
      .copyTo(grey(cv::Rect(195, 0, 100, 200)));
  tag_picture("tag36h11", 5, 8, size, {40, 30})
      .grey(cv::Rect(0, 0, 190, 200))
      .copyTo(grey(cv::Rect(0, 0, 190, 200)));
  TagDetector detector;
  const std::vector<Detection> found = detector.detect(grey);
  REQUIRE(found.size() == 3);
  CHECK(found[0].id == 3);
  CHECK(found[1].id == 5);
  CHECK(found[1].centre.x == Approx(79.5).margin(0.2));
  CHECK(found[2].centre.x == Approx(339.5).margin(0.2));
  CHECK(detector.detect(grey) == found);
  CHECK(TagDetector().detect(grey) == found);
}

TEST_CASE("Tags of one id come from left to right, wherever they lie") {
  cv::Mat1b grey(400, 400, 200);
  const std::vector<cv::Point> places{{280, 10}, {20, 280}, {150, 140}};
  for (const cv::Point& at : places) {
    tag_picture("tag36h11", 5, 8, {100, 100}, {5, 5}).grey.copyTo(grey(cv::Rect(at, cv::Size(100, 100))));
  }
  for (const bool mirrored : {false, true}) {
    cv::Mat1b turned = grey;
    if (mirrored) cv::rotate(grey, turned, cv::ROTATE_90_CLOCKWISE);
    const std::vector<Detection> found = TagDetector().detect(turned);
    REQUIRE(found.size() == 3);
    CHECK(found[0].centre.x < found[1].centre.x);
    CHECK(found[1].centre.x < found[2].centre.x);
  }
}

TEST_CASE("An image of any size, of any option, is no crash") {
  TagDetector plain, full(with("quad_decimate=1")), coarse(with("quad_decimate=3")),
      narrow(with("quad_sigma=4"));
  cv::RNG random(1);
  CHECK(plain.detect({}).empty());
  for (const auto& [rows, cols] : std::vector<std::pair<int, int>>{
           {1, 1},   {2, 2},    {1, 300},  {300, 1}, {3, 3},   {4, 300}, {300, 4},
           {7, 7},   {8, 8},    {9, 9},    {8, 300}, {300, 8}, {15, 15}, {16, 16},
           {17, 17}, {16, 300}, {300, 16}, {24, 24}, {25, 31}, {36, 36}, {37, 300}}) {
    INFO(rows << " rows, " << cols << " columns");
    cv::Mat1b noise(rows, cols);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    for (TagDetector* const detector : {&plain, &full, &coarse, &narrow})
      CHECK(detector->detect(noise).empty());
  }
}

TEST_CASE("A part of a larger image is looked at, not what lies beside it") {
  const auto picture = tag_picture("tag36h11", 1, 8);
  const cv::Rect inner(20, 10, 150, 150);
  const std::vector<Detection> found = TagDetector().detect(picture.grey(inner));
  CHECK(found == TagDetector().detect(picture.grey(inner).clone()));
  REQUIRE(found.size() == 1);
  CHECK(found[0].xy_px[0] == Approx(picture.corners_px[0] - 20).margin(0.2));
  CHECK(TagDetector().detect(picture.grey(cv::Rect(0, 0, 80, 200))).empty());
}

TEST_CASE("As many bits are corrected as was asked for") {
  auto picture = tag_picture("tag36h11", 0, 8);
  const cv::Rect bit(40 + 3 * 8, 30 + 3 * 8, 8, 8);
  picture.grey(bit) = 255 - picture.grey(bit);
  CHECK(TagDetector(with("corrected_bits=0")).detect(picture.grey).empty());
  const std::vector<Detection> found = TagDetector().detect(picture.grey);
  REQUIRE(found.size() == 1);
  CHECK(found[0].hamming == 1);
  const cv::Rect other(40 + 5 * 8, 30 + 4 * 8, 8, 8);
  picture.grey(other) = 255 - picture.grey(other);
  CHECK(TagDetector().detect(picture.grey).empty());
  CHECK(TagDetector(with("corrected_bits=2")).detect(picture.grey).size() == 1);
}

TEST_CASE("Detections of too small a margin are left out") {
  const auto picture = tag_picture("tag36h11", 0, 8);
  const double margin = TagDetector().detect(picture.grey).at(0).margin;
  DetectorOptions options;
  options.min_margin = margin;
  CHECK(TagDetector(options).detect(picture.grey).size() == 1);
  options.min_margin = margin + 0.01;
  CHECK(TagDetector(options).detect(picture.grey).empty());
}

TEST_CASE("Options reach the library") {
  cv::Mat1b small = tag_picture("tag36h11", 0, 2, {60, 60}, {20, 20}).grey;
  CHECK(TagDetector(with("quad_decimate=1")).detect(small).size() == 1);
  CHECK(TagDetector(with("quad_decimate=4")).detect(small).empty());
  const auto picture = tag_picture("tag36h11", 0, 8);
  CHECK(TagDetector(with("min_cluster=100000")).detect(picture.grey).empty());
  CHECK(TagDetector(with("quad_sigma=4")).detect(picture.grey) != TagDetector().detect(picture.grey));
  CHECK(TagDetector().detect(picture.grey).size() == 1);
  CHECK(TagDetector(with("critical_angle=89")).detect(picture.grey).empty());
  cv::Mat1b faint;
  picture.grey.convertTo(faint, CV_8U, 0.1, 100);
  CHECK(TagDetector().detect(faint).size() == 1);
  CHECK(TagDetector(with("min_contrast=60")).detect(faint).empty());
}

TEST_CASE("Options that can't be are refused with words") {
  CHECK_THROWS_WITH(with("family=tag36h12"), Contains("tag36h11") && Contains("tagStandard52h13"));
  CHECK_THROWS_WITH(with("corrected_bits=4"), Contains("0 to 3"));
  CHECK_THROWS_WITH(TagDetector(with("corrected_bits=3")), Contains("1.2 GB") && Contains("take 2 at most"));
  DetectorOptions few = with("family=tag16h5");
  few.corrected_bits = 3;
  CHECK_THROWS_WITH(TagDetector(few), Contains("take 2 at most"));
  DetectorOptions large = with("family=tagStandard52h13");
  large.corrected_bits = 2;
  CHECK_THROWS_WITH(TagDetector(large), Contains("6.3 GB") && Contains("take 1 at most"));
  CHECK_THROWS_WITH(TagDetector(with("quad_decimate=2.5")), Contains("2.5"));
  CHECK_NOTHROW(TagDetector(with("quad_decimate=1.5")));
  DetectorOptions unknown;
  unknown.family = "aruco";
  CHECK_THROWS_AS(TagDetector(unknown), Error);
}
