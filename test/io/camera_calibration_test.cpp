#include "esi/io/camera_calibration.hpp"

#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

CameraCalibration parsed(const std::string& text) { return parse_camera_calibration(text, "lens"); }

void check_intrinsics(const CameraCalibration& camera) {
  CHECK(camera.fx == 250.5);
  CHECK(camera.fy == 251.0);
  CHECK(camera.cx == 173.25);
  CHECK(camera.cy == 129.0);
}

/// As OpenCV itself writes it.
std::string opencv_text(const std::string& extension, int coefficients) {
  cv::FileStorage file(extension, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "image_width" << 346 << "image_height" << 260;
  file << "camera_matrix" << cv::Mat1d({3, 3}, {250.5, 0.0, 173.25, 0.0, 251.0, 129.0, 0.0, 0.0, 1.0});
  cv::Mat1d k(coefficients, 1);
  for (int i = 0; i < coefficients; ++i) k(i) = 0.1 * (i + 1);
  file << "distortion_coefficients" << k;
  return file.releaseAndGetString();
}

const std::string kYaml = "%YAML:1.0\n---\nK: [250.5, 0, 173.25, 0, 251.0, 129.0, 0, 0, 1]\n";

}  // namespace

TEST_CASE("calibrations that OpenCV wrote are read") {
  const auto extension = GENERATE(".yml", ".xml", ".json");
  const CameraCalibration camera = parsed(opencv_text(extension, 5));
  check_intrinsics(camera);
  CHECK(camera.size == SensorSize{346, 260});
  CHECK(camera.model == LensModel::radial_tangential);
  REQUIRE(camera.distortion.size() == 5);
  CHECK(camera.distortion[4] == Approx(0.5));
}

TEST_CASE("RPG's calib.txt is read") {
  const CameraCalibration camera = parsed("250.5 251 173.25 129 -0.3 0.1 -2e-4 1.5E-3 0\n");
  check_intrinsics(camera);
  CHECK(camera.size == SensorSize{});
  CHECK(camera.model == LensModel::radial_tangential);
  CHECK(camera.distortion == std::vector<double>{-0.3, 0.1, -2e-4, 1.5e-3, 0.0});
}

TEST_CASE("a lens model is what the file says") {
  CHECK(parsed(kYaml + "D: [0.1, 0.2, 0.3, 0.4]\n").model == LensModel::radial_tangential);
  for (const char* says :
       {"distortion_model: equidistant\n", "distortion_model: fisheye\n", "fisheye_model: 1\n"}) {
    CHECK(parsed(kYaml + "D: [0.1, 0.2, 0.3, 0.4]\n" + says).model == LensModel::equidistant);
  }
}

TEST_CASE("the camera_info of ROS is read, which has no YAML head") {
  const CameraCalibration camera = parsed(
      "image_width: 346\nimage_height: 260\ncamera_name: davis\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [250.5, 0, 173.25, 0, 251.0, 129.0, 0, 0, 1]\ndistortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.3, 0.1, 0, 0, 0]\n");
  check_intrinsics(camera);
  CHECK(camera.size == SensorSize{346, 260});
  CHECK(camera.distortion.at(1) == 0.1);
}

TEST_CASE("what is no calibration is refused with the file and what is wrong") {
  struct Row {
    std::string text;
    const char* told;
  };
  const auto row = GENERATE(
      Row{"", "fx fy cx cy"}, Row{"250 251 173\n", "fx fy cx cy"},
      Row{"1 2 3 4 5 6 7 8 9 10\n", "fx fy cx cy"}, Row{"250 251 173 129 0 0 0 0 x\n", "fx fy cx cy"},
      Row{"250,251,173,129,0,0,0,0,0\n", "fx fy cx cy"}, Row{"0 251 173 129 0 0 0 0 0\n", "focal length"},
      Row{"-5 251 173 129 0 0 0 0 0\n", "focal length"}, Row{"250 251 173 129 1e9 0 0 0 0\n", "coefficient"},
      Row{kYaml, "distortion_coefficients"}, Row{kYaml + "D: [0.1, .nan]\n", "coefficient"},
      Row{kYaml + "D: [a, b]\n", "no numbers"}, Row{kYaml + "D: 4\n", "no matrix"},
      Row{kYaml + "D: [0]\ndistortion_model: omni\n", "omni"},
      Row{kYaml + "D: [1, 1, 1, 1, 1]\nfisheye_model: 1\n", "more than the 4"},
      Row{"%YAML:1.0\n---\nD: [0]\n", "camera_matrix"}, Row{"%YAML:1.0\n---\nK: [1, 2]\nD: [0]\n", "9"},
      Row{"%YAML:1.0\n---\nK: [1, 2\n", "calibration"},
      Row{"<?xml version=\"1.0\"?><opencv_storage><K>", "calibration"}, Row{"{\"K\": ", "calibration"},
      Row{"\x89HDF\r\n", "calibration"}, Row{"frame,t_us\n", "calibration"});
  INFO(row.text);
  CHECK_THROWS_WITH(parsed(row.text), Contains("lens: ") && Contains(row.told));
}

TEST_CASE("a calibration of another camera is refused") {
  CameraCalibration camera = parsed(opencv_text(".yml", 4));
  CHECK_NOTHROW(require_size(camera, {346, 260}, "lens"));
  CHECK_THROWS_WITH(require_size(camera, {240, 180}, "lens"), Contains("346x260") && Contains("240x180"));
  camera.size = {};
  CHECK_NOTHROW(require_size(camera, {240, 180}, "lens"));
  CHECK_THROWS_WITH(require_size(camera, {128, 128}, "lens"), Contains("optical axis"));
  CHECK_THROWS_WITH(require_size(camera, {174, 129}, "lens"), Contains("optical axis"));
}

TEST_CASE("a calibration is read from its file") {
  const test::TempFolder folder;
  check_intrinsics(read_camera_calibration(folder.write("calib.txt", "250.5 251 173.25 129 0 0 0 0 0")));
  CHECK_THROWS_WITH(read_camera_calibration(folder / "absent.txt"), Contains("absent.txt"));
}
