#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "esi/io/output/output_folder.hpp"

namespace esi {

/// What a folder of motion fields may hold.
extern const FolderContent kMotionContent;

/// A field of motion (right and down, one vector a pixel) as a Middlebury .flo file: "PIEH", width and height
/// as 32-bit integers, then the vectors row by row, all little-endian. cv::readOpticalFlow reads it.
std::string flo_file(const cv::Mat2f& motion);

/// The field as a picture: the hue is the direction (red right, then by yellow, green and blue clockwise),
/// and the faster, the more of it; the field's fastest pixel has all of it, and white stands still. Fields
/// whose fastest pixel is slower than 1 are shown as if it were 1.
cv::Mat3b motion_picture(const cv::Mat2f& motion);

/// A folder with flow_0000000000.flo and .png and so on, and run.json last.
class MotionFolder {
 public:
  /// See OutputFolder. Such a folder can't be resumed.
  MotionFolder(const std::filesystem::path& path, const SinkOptions& options, const std::string& fingerprint);

  void write(const cv::Mat2f& motion, std::int64_t index);
  void complete(const std::string& manifest) { folder_.complete(manifest); }

 private:
  OutputFolder folder_;
};

}  // namespace esi
