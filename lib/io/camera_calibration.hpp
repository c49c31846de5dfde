#pragma once

#include <filesystem>
#include <string>

#include "esi/core/camera_calibration.hpp"

namespace esi {

/// Reads a camera's calibration: OpenCV's YAML, XML or JSON (camera_matrix or K, distortion_coefficients or
/// D, image_width and image_height, and where the lens is no ordinary one distortion_model or fisheye_model),
/// the camera_info of ROS, or RPG's calib.txt ("fx fy cx cy k1 k2 p1 p2 k3"). Throws a usage Error "FILE:
/// what, what to do" for what is none of these, or can't be.
CameraCalibration read_camera_calibration(const std::filesystem::path& path);

/// The same for a file's text; `name` is what messages call it.
CameraCalibration parse_camera_calibration(const std::string& text, const std::string& name);

/// Throws a usage Error where the camera can't be that of such a sensor: another size, or an optical axis
/// outside of it.
void require_size(const CameraCalibration& camera, SensorSize sensor, const std::string& name);

}  // namespace esi
