#include "esi/io/output/encode_png.hpp"

#include <fmt/format.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// Without a level OpenCV takes zlib's fastest with one filter (Sub) for all rows: measured twice as fast as
/// any explicit level, and never larger on event images. Elsewhere run lengths beat string matching in both
/// respects.
std::vector<int> encoder_settings(int level) {
  if (level == 1) return {};
  return {cv::IMWRITE_PNG_COMPRESSION, level, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE};
}

std::string big_endian(int value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const cv::Mat1b& grey, int level) {
  std::vector<std::uint8_t> png;
  try {
    if (!grey.empty() && cv::imencode(".png", grey, png, encoder_settings(level))) return png;
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("a {}x{} image cannot be encoded as PNG: {}", grey.cols, grey.rows, error.err));
  }
  throw Error(fmt::format("a {}x{} image cannot be encoded as PNG", grey.cols, grey.rows));
}

bool is_whole_png(const std::filesystem::path& path, SensorSize size) {
  using namespace std::string_literals;
  const std::string head =
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"s + big_endian(size.width_px) + big_endian(size.height_px);
  const std::string tail = "\0\0\0\0IEND\xae\x42\x60\x82"s;
  std::ifstream file(path, std::ios::binary);
  std::string found(head.size(), '\0');
  if (!file.read(found.data(), static_cast<std::streamsize>(found.size())) || found != head) return false;
  found.resize(tail.size());
  file.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  return file.read(found.data(), static_cast<std::streamsize>(found.size())) && found == tail;
}

}  // namespace esi
