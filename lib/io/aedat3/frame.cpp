#include "esi/io/aedat3/frame.hpp"

#include <cstring>
#include <opencv2/imgproc.hpp>

namespace esi {
namespace {

// A frame that shows a part of a larger sensor than this is not believed: a few bytes would become its image.
constexpr std::int64_t kMaxSensor_px = std::int64_t{1} << 21;

/// As it is stored, little-endian. The pixels follow, 16 bits per channel.
struct Head {
  std::uint32_t info;  ///< bit 0 valid, bits 1..3 number of channels
  std::int32_t start_of_frame, end_of_frame, start_of_exposure, end_of_exposure;
  std::int32_t width_px, height_px, x_px, y_px;
};
static_assert(sizeof(Head) == 36);

Interval exposure_of(const Aedat3Packet& packet, const Head& head) {
  const Interval exposure{packet.t_us(head.start_of_exposure), packet.t_us(head.end_of_exposure)};
  return exposure.is_empty() ? Interval{exposure.end_us, exposure.end_us} : exposure;
}

/// The frame's pixels, or an empty image where number of channels, size and bytes don't go together.
cv::Mat grey_pixels(const Head& head, std::span<const std::byte> stored) {
  const auto channels = static_cast<int>(head.info >> 1U & 7U);
  if (channels != 1 && channels != 3 && channels != 4) return {};
  if (head.width_px <= 0 || head.height_px <= 0) return {};
  const auto pixel_bytes = static_cast<std::size_t>(channels) * sizeof(std::uint16_t);
  const std::size_t possible_pixels = stored.size() / pixel_bytes;
  const std::size_t pixels =
      static_cast<std::size_t>(head.width_px) * static_cast<std::size_t>(head.height_px);
  if (pixels > possible_pixels) return {};
  cv::Mat image(head.height_px, head.width_px, CV_16UC(channels));
  std::memcpy(image.data, stored.data(), pixels * pixel_bytes);
  if (channels == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, channels == 3 ? cv::COLOR_RGB2GRAY : cv::COLOR_RGBA2GRAY);
  return grey;
}

/// `image` at its place on the sensor, or an empty image where it does not fit.
cv::Mat placed(const cv::Mat& image, const Head& head, SensorSize sensor) {
  const std::int64_t right_px = std::int64_t{head.x_px} + head.width_px;
  const std::int64_t bottom_px = std::int64_t{head.y_px} + head.height_px;
  if (head.x_px < 0 || head.y_px < 0 || right_px > sensor.width_px || bottom_px > sensor.height_px) return {};
  if (image.cols == sensor.width_px && image.rows == sensor.height_px) return image;
  if (std::int64_t{sensor.width_px} * sensor.height_px > kMaxSensor_px) return {};
  cv::Mat whole = cv::Mat::zeros(sensor.height_px, sensor.width_px, image.type());
  image.copyTo(whole(cv::Rect({head.x_px, head.y_px}, image.size())));
  return whole;
}

}  // namespace

Aedat3Frame decode_aedat3_frame(const Aedat3Packet& packet, std::span<const std::byte> event,
                                std::optional<SensorSize> sensor) {
  Head head;
  std::memcpy(&head, event.data(), sizeof head);
  if ((head.info & 1U) == 0) return {};
  cv::Mat image = grey_pixels(head, event.subspan(sizeof head));
  if (sensor && !image.empty()) image = placed(image, head, *sensor);
  if (image.empty()) return {std::nullopt, true};
  return {IntensityFrame{exposure_of(packet, head), image}, false};
}

}  // namespace esi
