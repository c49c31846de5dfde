#include "esi/io/rosbag/image.hpp"

#include <opencv2/imgproc.hpp>

#include "esi/core/event.hpp"
#include "esi/io/rosbag/message.hpp"

namespace esi {
namespace {

struct Encoding {
  std::string_view name;
  int type;
  int to_grey;  ///< as cv::cvtColor takes it; kIsGrey: it is
};

constexpr int kIsGrey = -1;
constexpr Encoding kEncodings[] = {
    {"mono8", CV_8UC1, kIsGrey},
    {"8UC1", CV_8UC1, kIsGrey},
    {"mono16", CV_16UC1, kIsGrey},
    {"16UC1", CV_16UC1, kIsGrey},
    {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
    {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
    {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
    {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
};

const Encoding* find(std::string_view name) {
  for (const Encoding& encoding : kEncodings) {
    if (encoding.name == name) return &encoding;
  }
  return nullptr;
}

void swap_bytes(cv::Mat& image) {
  for (auto pixel = image.begin<std::uint16_t>(); pixel != image.end<std::uint16_t>(); ++pixel) {
    *pixel = static_cast<std::uint16_t>(*pixel << 8 | *pixel >> 8);
  }
}

/// A copy of its own, 8 or 16 bits grey.
cv::Mat grey_copy(const cv::Mat& image, int to_grey, bool is_bigendian) {
  cv::Mat grey;
  if (to_grey != kIsGrey) {
    cv::cvtColor(image, grey, to_grey);
    return grey;
  }
  grey = image.clone();
  if (is_bigendian && grey.depth() == CV_16U) swap_bytes(grey);
  return grey;
}

}  // namespace

std::optional<IntensityFrame> decode_ros_image(std::span<const std::byte> bytes) {
  RosMessage message(bytes);
  const std::int64_t t_us = message.header_us();
  const std::size_t height = message.number<std::uint32_t>();
  const std::size_t width = message.number<std::uint32_t>();
  const Encoding* const encoding = find(message.text());
  const bool is_bigendian = message.number<std::uint8_t>() != 0;
  const std::size_t row_bytes = message.number<std::uint32_t>();
  const auto pixels = message.array();
  if (!message.is_whole() || encoding == nullptr || width < 1 || height < 1 || width > kMaxSensorSide_px ||
      height > kMaxSensorSide_px || row_bytes < width * CV_ELEM_SIZE(encoding->type) ||
      row_bytes % CV_ELEM_SIZE1(encoding->type) != 0 || row_bytes * height != pixels.size()) {
    return std::nullopt;
  }
  const cv::Mat image(static_cast<int>(height), static_cast<int>(width), encoding->type,
                      const_cast<std::byte*>(pixels.data()), row_bytes);
  return IntensityFrame{{t_us, t_us}, grey_copy(image, encoding->to_grey, is_bigendian)};
}

}  // namespace esi
