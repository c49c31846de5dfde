#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace esi {

/// The AprilTags that can be seen.
struct TrueTags {
  std::string family;
  std::vector<int> ids;          ///< each once
  std::map<int, double> size_m;  ///< edge of the black square; not every id need have one
};

/// Pinhole camera. Pixel centres are at whole numbers.
struct CameraModel {
  int width_px = 0, height_px = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  std::vector<double> distortion;         ///< OpenCV's k1, k2, p1, p2, k3, ...; may be empty
};

/// Where a tag's corners are at one time.
struct TrueCorners {
  std::int64_t t_us = 0;
  int id = 0;
  bool visible = false;
  std::array<double, 8> xy_px{};  ///< x1, y1, ..., x4, y4; pixel centres at integers
};

/// One line of a TUM track.
struct TrackPose {
  std::int64_t t_us = 0;
  std::array<double, 3> position_m{};
  std::array<double, 4> quaternion_xyzw{0, 0, 0, 1};
};

}  // namespace esi
