#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace esi {

/// A picture on the disk and its time.
struct ListedPicture {
  std::int64_t t_us = 0;
  std::filesystem::path file;
};

/// An images.txt as RPG and TUM have it, "<seconds> <file>" a line, files relative to its folder; by time.
/// Throws an Error with the line.
std::vector<ListedPicture> read_picture_list(const std::filesystem::path& path);

/// The frames of a folder that esi-recon, rpg_e2vid or another tool made: as its images.txt lists them, else
/// the PNG files by name, with the lines of timestamps.txt as their times. Throws a usage Error where there
/// is neither, where their numbers differ, or where a picture is absent.
std::vector<ListedPicture> list_frames(const std::filesystem::path& folder);

/// As 8 bits of grey. Throws an Error for a file that is no picture.
cv::Mat1b read_picture(const std::filesystem::path& file);

}  // namespace esi
