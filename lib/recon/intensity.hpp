#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

#include "esi/core/event.hpp"
#include "esi/core/frame.hpp"

namespace esi {

/// An intensity frame's values as shares of white, 0 to 1, whether it has 8 or 16 bits.
/// Throws an Error that names the method where the frame isn't of the sensor's size or has another type.
cv::Mat1f relative_intensity(const IntensityFrame& frame, SensorSize sensor, std::string_view method);

}  // namespace esi
