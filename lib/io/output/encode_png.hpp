#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "esi/core/event.hpp"

namespace esi {

/// An 8-bit grey PNG file in memory. `level` 0 stores, 1 is the fastest that compresses, 2 to 9 try harder.
/// Throws an Error for an image without pixels.
std::vector<std::uint8_t> encode_png(const cv::Mat1b& grey, int level);

/// Whether the file is a PNG of that size that is there to its last byte.
bool is_whole_png(const std::filesystem::path& path, SensorSize size);

}  // namespace esi
