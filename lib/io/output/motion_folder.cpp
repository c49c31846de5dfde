#include "esi/io/output/motion_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>

#include "esi/core/error.hpp"
#include "esi/io/output/output_file.hpp"

namespace esi {
namespace {

constexpr double kLeastFullSpeed = 1.0;

void append(std::string& bytes, std::uint32_t value) {
  for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(value >> shift & 0xff);
}

bool is_of_motion(std::string_view name) {
  constexpr std::string_view prefix = "flow_";
  constexpr std::size_t extension = 4;
  if (name == "run.json") return true;
  if (!name.starts_with(prefix) || !(name.ends_with(".flo") || name.ends_with(".png"))) return false;
  const auto digits = name.substr(prefix.size(), name.size() - prefix.size() - extension);
  return !digits.empty() &&
         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
}

constexpr bool has_no_folder(std::string_view /*name*/) { return false; }

}  // namespace

const FolderContent kMotionContent{"fields of motion", is_of_motion, has_no_folder, false};

std::string flo_file(const cv::Mat2f& motion) {
  std::string bytes = "PIEH";
  append(bytes, static_cast<std::uint32_t>(motion.cols));
  append(bytes, static_cast<std::uint32_t>(motion.rows));
  bytes.reserve(bytes.size() + 8 * motion.total());
  for (const cv::Vec2f& v : motion) {
    append(bytes, std::bit_cast<std::uint32_t>(v[0]));
    append(bytes, std::bit_cast<std::uint32_t>(v[1]));
  }
  return bytes;
}

cv::Mat3b motion_picture(const cv::Mat2f& motion) {
  std::array<cv::Mat1f, 2> parts;
  cv::split(motion, parts.data());
  cv::Mat1f speed, angle_deg;
  cv::cartToPolar(parts[0], parts[1], speed, angle_deg, true);
  double fastest = 0.0;
  cv::minMaxLoc(speed, nullptr, &fastest);
  cv::Mat1f share;
  speed.convertTo(share, CV_32F, 1.0 / std::max(fastest, kLeastFullSpeed));
  const std::array<cv::Mat1f, 3> hsv{angle_deg, share, cv::Mat1f(speed.size(), 1.0F)};
  cv::Mat3f colours;
  cv::merge(hsv.data(), hsv.size(), colours);
  cv::cvtColor(colours, colours, cv::COLOR_HSV2BGR);
  cv::Mat3b picture;
  colours.convertTo(picture, CV_8U, 255.0);
  return picture;
}

MotionFolder::MotionFolder(const std::filesystem::path& path, const SinkOptions& options,
                           const std::string& fingerprint)
    : folder_(path, options, fingerprint, kMotionContent) {}

void MotionFolder::write(const cv::Mat2f& motion, std::int64_t index) {
  const auto place = folder_.path() / fmt::format("flow_{:010d}", index);
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", motion_picture(motion), png)) {
    throw Error(place.string() + ".png: the picture cannot be encoded");
  }
  write_file(place.string() + ".flo", std::string_view(flo_file(motion)));
  write_file(place.string() + ".png", std::as_bytes(std::span<const std::uint8_t>(png)));
}

}  // namespace esi
