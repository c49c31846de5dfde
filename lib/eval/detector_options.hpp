#pragma once

#include <cstdint>
#include <string>

#include "esi/core/options.hpp"

namespace esi {

/// How tags are looked for. Defaults are those of the AprilTag library (Olson 2011; Wang & Olson 2016),
/// except corrected_bits, of which it has 2, and quad_decimate, also 2: on a DAVIS346 that costs half of the
/// tags that are some 30 px large.
struct DetectorOptions {
  std::string family = "tag36h11";
  std::int64_t corrected_bits = 1;
  double min_margin = 0.0;

  double quad_decimate = 1.0;
  double quad_sigma_px = 0.0;
  bool refine_edges = true;
  double decode_sharpening = 0.25;

  std::int64_t min_cluster_px = 5;
  std::int64_t max_maxima = 10;
  double critical_angle_deg = 10.0;
  double max_line_fit_mse_px2 = 10.0;
  std::int64_t min_contrast = 5;
  bool deglitch = false;

  void declare(OptionTable& table);
  /// Throws a usage Error on values that contradict one another, among them corrected bits whose table would
  /// take more than half a gigabyte.
  void check() const;
};

}  // namespace esi
