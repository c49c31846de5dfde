#include "esi/io/camera_calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <sstream>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr double kLargestFocus_px = 1e6;
constexpr double kLargestCoefficient = 1e3;
constexpr std::size_t kCoefficientsOfCalibTxt = 5;

cv::FileNode first_of(const cv::FileStorage& file, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const cv::FileNode node = file[name]; !node.empty()) return node;
  }
  return {};
}

/// A list of numbers, or a matrix row by row.
std::vector<double> numbers(const cv::FileNode& node, const char* what) {
  const cv::FileNode list = node.isMap() ? node["data"] : node;
  if (!list.isSeq()) throw usage_error(fmt::format("{} is missing, or no matrix", what));
  std::vector<double> values;
  for (const cv::FileNode& value : list) {
    if (!value.isInt() && !value.isReal()) throw usage_error(fmt::format("{} holds no numbers", what));
    values.push_back(value.real());
  }
  return values;
}

int whole(const cv::FileNode& node) { return node.isInt() ? static_cast<int>(node) : 0; }

LensModel lens_of(const cv::FileStorage& file) {
  if (whole(file["fisheye_model"]) != 0) return LensModel::equidistant;
  const cv::FileNode node = file["distortion_model"];
  const std::string name = node.isString() ? node.string() : "plumb_bob";
  if (name == "equidistant" || name == "fisheye") return LensModel::equidistant;
  if (name == "plumb_bob" || name == "radtan" || name == "rational_polynomial") {
    return LensModel::radial_tangential;
  }
  throw usage_error(fmt::format("the distortion model '{}' is not known", name));
}

CameraCalibration from_storage(const std::string& text) {
  const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  CameraCalibration camera;
  camera.size = {whole(file["image_width"]), whole(file["image_height"])};
  const auto k = numbers(first_of(file, {"camera_matrix", "K", "Camera_Matrix"}), "camera_matrix (or K)");
  if (k.size() != 9) throw usage_error(fmt::format("camera_matrix has {} numbers instead of 9", k.size()));
  camera.fx = k[0];
  camera.cx = k[2];
  camera.fy = k[4];
  camera.cy = k[5];
  camera.distortion = numbers(first_of(file, {"distortion_coefficients", "D", "Distortion_Coefficients"}),
                              "distortion_coefficients (or D)");
  camera.model = lens_of(file);
  return camera;
}

CameraCalibration from_calib_txt(const std::string& text) {
  std::istringstream line(text);
  line.imbue(std::locale::classic());
  CameraCalibration camera;
  line >> camera.fx >> camera.fy >> camera.cx >> camera.cy;
  for (double k = 0; line >> k;) camera.distortion.push_back(k);
  if (!line.eof() || camera.distortion.size() != kCoefficientsOfCalibTxt) {
    throw usage_error(
        "it is neither YAML, XML nor JSON with a camera_matrix, nor a line 'fx fy cx cy k1 k2 p1 p2 k3'");
  }
  return camera;
}

bool is_calib_txt(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ||
         std::string_view("+-.0123456789").find(text[first]) != std::string::npos;
}

/// FileStorage knows YAML by its first line, which ROS leaves out.
std::string with_yaml_head(const std::string& text) {
  const bool has_head = text.starts_with('%') || text.starts_with('<') || text.starts_with('{');
  return has_head ? text : "%YAML:1.0\n---\n" + text;
}

void check(const CameraCalibration& camera) {
  for (const double focus : {camera.fx, camera.fy}) {
    if (!(focus > 0.0 && focus <= kLargestFocus_px)) {
      throw usage_error(fmt::format("a focal length of {} px can't be", focus));
    }
  }
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) throw usage_error("cx or cy is no number");
  const std::size_t most = camera.model == LensModel::equidistant ? 4 : 8;
  for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
    const double k = camera.distortion[i];
    if (!(std::abs(k) <= kLargestCoefficient)) {
      throw usage_error(fmt::format("a distortion coefficient of {} can't be", k));
    }
    if (i >= most && k != 0.0) {
      throw usage_error(fmt::format("{} distortion coefficients are more than the {} of this lens model",
                                    camera.distortion.size(), most));
    }
  }
}

}  // namespace

CameraCalibration read_camera_calibration(const std::filesystem::path& path) {
  return parse_camera_calibration(read_text_file(path, kMaxBytes), path.string());
}

CameraCalibration parse_camera_calibration(const std::string& text, const std::string& name) {
  try {
    const CameraCalibration camera =
        is_calib_txt(text) ? from_calib_txt(text) : from_storage(with_yaml_head(text));
    check(camera);
    return camera;
  } catch (const cv::Exception& error) {
    throw usage_error(fmt::format("{}: it can't be read as a camera calibration: {}", name, error.err));
  } catch (const Error& error) {
    throw usage_error(fmt::format("{}: {}", name, error.what()));
  }
}

void require_size(const CameraCalibration& camera, SensorSize sensor, const std::string& name) {
  const bool says_size = camera.size.width_px != 0 || camera.size.height_px != 0;
  if (says_size && camera.size != sensor) {
    throw usage_error(fmt::format("{}: it is for images of {}, and the sensor has {}", name,
                                  to_string(camera.size), to_string(sensor)));
  }
  const bool is_inside =
      camera.cx >= 0.0 && camera.cy >= 0.0 && camera.cx < sensor.width_px && camera.cy < sensor.height_px;
  if (is_inside) return;
  throw usage_error(fmt::format("{}: the optical axis (cx {}, cy {}) lies outside the sensor of {}", name,
                                camera.cx, camera.cy, to_string(sensor)));
}

}  // namespace esi
