#include "esi/io/aedat4/frame.hpp"

#include <aedat4_generated.h>

#include <opencv2/imgproc.hpp>

namespace esi {
namespace {

// Times beyond this (36 thousand years) are garbage, and adding to them could overflow.
constexpr std::int64_t kMaxTime_us = std::int64_t{1} << 60;
// A frame that shows a part of a larger sensor than this is not believed: a few bytes would become its image.
constexpr std::int64_t kMaxSensor_px = std::int64_t{1} << 26;

bool is_time(std::int64_t t_us) { return t_us > -kMaxTime_us && t_us < kMaxTime_us; }

// `timestamp` is the exposure's middle in some recordings and its start in others, where `exposure` is given.
std::optional<Interval> exposure_of(const aedat4::Frame& frame) {
  const std::int64_t begin_us = frame.start_of_exposure();
  const std::int64_t end_us = frame.end_of_exposure();
  const std::int64_t t_us = frame.timestamp();
  if (!is_time(begin_us) || !is_time(end_us) || !is_time(t_us) || !is_time(frame.exposure()))
    return std::nullopt;
  if (begin_us > 0 && end_us > begin_us) return Interval{begin_us, end_us};
  if (frame.exposure() > 0) return Interval{t_us, t_us + frame.exposure()};
  return Interval{t_us, t_us};
}

/// A view of the frame's pixels, or an empty image where format, size and pixels don't go together.
cv::Mat pixels_of(const aedat4::Frame& frame) {
  const int type = static_cast<std::uint8_t>(frame.format());  // no known one is negative
  const int depth = CV_MAT_DEPTH(type);
  const int channels = CV_MAT_CN(type);
  const bool is_known =
      (depth == CV_8U || depth == CV_16U) && (channels == 1 || channels == 3 || channels == 4);
  if (!is_known || frame.size_x() <= 0 || frame.size_y() <= 0 || frame.pixels() == nullptr) return {};
  const auto pixels = static_cast<std::size_t>(frame.size_x()) * static_cast<std::size_t>(frame.size_y());
  if (frame.pixels()->size() < pixels * CV_ELEM_SIZE(type)) return {};
  return {frame.size_y(), frame.size_x(), type, const_cast<std::uint8_t*>(frame.pixels()->data())};
}

cv::Mat grey_copy(const cv::Mat& image) {
  cv::Mat grey;
  if (image.channels() == 1) {
    image.copyTo(grey);
  } else {
    cv::cvtColor(image, grey, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  }
  return grey;
}

/// `image` at its place on the sensor, or an empty image where it does not fit.
cv::Mat placed(const cv::Mat& image, cv::Point position, SensorSize sensor) {
  const cv::Rect part(position, image.size());
  const cv::Rect whole(0, 0, sensor.width_px, sensor.height_px);
  if ((part & whole) != part) return {};
  if (part == whole) return image;
  if (std::int64_t{whole.width} * whole.height > kMaxSensor_px) return {};
  cv::Mat full = cv::Mat::zeros(whole.size(), image.type());
  image.copyTo(full(part));
  return full;
}

}  // namespace

std::optional<IntensityFrame> decode_aedat4_frame(std::span<const std::byte> flatbuffer,
                                                  std::optional<SensorSize> sensor) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(flatbuffer.data());
  flatbuffers::Verifier verifier(data, flatbuffer.size());
  if (!verifier.VerifySizePrefixedBuffer<aedat4::Frame>("FRME")) return std::nullopt;
  const auto& frame = *flatbuffers::GetSizePrefixedRoot<aedat4::Frame>(data);

  const auto exposure = exposure_of(frame);
  const cv::Mat pixels = pixels_of(frame);
  if (!exposure || pixels.empty()) return std::nullopt;
  cv::Mat image = grey_copy(pixels);
  if (sensor) image = placed(image, {frame.position_x(), frame.position_y()}, *sensor);
  if (image.empty()) return std::nullopt;
  return IntensityFrame{*exposure, image};
}

}  // namespace esi
