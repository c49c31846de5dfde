#include "esi/sim/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// AprilTag crashes on images of a few pixels, and a tag needs some.
constexpr int kMinSide_px = 16;
constexpr int kMaxSide_px = 4096;

void check_size(const std::string& text) {
  const SensorSize size = parse_sensor_size(text);
  const auto [low, high] = std::minmax(size.width_px, size.height_px);
  if (low < kMinSide_px || high > kMaxSide_px) {
    throw usage_error(
        fmt::format("sensor size '{}': each side must be {} to {} px", text, kMinSide_px, kMaxSide_px));
  }
}

SensorSize scaled(SensorSize size, double scale) {
  const auto side = [scale](int px) {
    return std::max(kMinSide_px, static_cast<int>(std::lround(px * scale)));
  };
  return {side(size.width_px), side(size.height_px)};
}

}  // namespace

void CameraOptions::declare(OptionTable& table) {
  table.text("sensor", sensor, "sensor size WIDTHxHEIGHT in px (a DAVIS346 has 346x260)", check_size);
  table.real("fov_deg", fov_deg, {5.0, 150.0}, "deg", "horizontal field of view of the whole sensor");
  table.real(
      "scale", scale, {0.05, 4.0}, "",
      "times so many pixels a side and so long a focal length in px: the same view, coarser or finer (0.37 "
      "makes 128x96 of 346x260)");
  table.text("crop", crop, "keep only WIDTHxHEIGHT px in the middle of the (scaled) sensor",
             [](const std::string& text) {
               if (!text.empty()) check_size(text);
             });
}

Camera::Camera(const CameraOptions& options) {
  const SensorSize whole = scaled(parse_sensor_size(options.sensor), options.scale);
  size = options.crop.empty() ? whole : parse_sensor_size(options.crop);
  if (size.width_px > whole.width_px || size.height_px > whole.height_px) {
    throw usage_error(fmt::format("option crop: {} is larger than the sensor's {} (sensor times scale)",
                                  options.crop, to_string(whole)));
  }
  origin_px = {(whole.width_px - size.width_px) / 2, (whole.height_px - size.height_px) / 2};
  focal_px = 0.5 * whole.width_px / std::tan(options.fov_deg * std::numbers::pi / 360.0);
  centre_px = {0.5 * (whole.width_px - 1) - origin_px[0], 0.5 * (whole.height_px - 1) - origin_px[1]};
}

}  // namespace esi
