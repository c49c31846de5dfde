#include "esi/recon/intensity.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"
#include "esi/core/time.hpp"

namespace esi {

cv::Mat1f relative_intensity(const IntensityFrame& frame, SensorSize sensor, std::string_view method) {
  const cv::Mat& image = frame.image;
  if (image.cols != sensor.width_px || image.rows != sensor.height_px) {
    throw Error(
        fmt::format("{}: the intensity frame at {} s has {}x{} px and the sensor {}; frames and events "
                    "must be of the same pixels",
                    method, seconds_text(frame.exposure.end_us), image.cols, image.rows, to_string(sensor)));
  }
  if (image.type() != CV_8UC1 && image.type() != CV_16UC1) {
    throw Error(fmt::format("{}: the intensity frame at {} s is not a grey image of 8 or 16 bits", method,
                            seconds_text(frame.exposure.end_us)));
  }
  cv::Mat1f shares;
  image.convertTo(shares, CV_32F, image.type() == CV_8UC1 ? 1.0 / 255.0 : 1.0 / 65535.0);
  return shares;
}

}  // namespace esi
