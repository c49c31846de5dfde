#pragma once

#include <string>
#include <string_view>

#include "esi/core/event.hpp"

namespace esi {

/// A family of event camera chips that share one sensor size.
struct CameraChip {
  std::string_view name;  ///< "DAVIS346"
  SensorSize size;
  bool is_davis;  ///< takes intensity frames, and jAER gives its pixels DAVIS addresses
};

/// The chip that a recording names, such as "eu.seebetter.ini.chips.davis.Davis346blue" or "DAVIS240C".
/// nullptr when it is not known.
const CameraChip* find_camera_chip(std::string_view described);

/// The chip of exactly this name, in upper or lower case. Throws a usage Error that lists the names.
const CameraChip& require_camera_chip(std::string_view name);

/// "DVS128, DAVIS128, ..."
std::string camera_chip_names();

}  // namespace esi
