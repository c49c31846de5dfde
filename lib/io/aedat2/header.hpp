#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "esi/io/byte_window.hpp"
#include "esi/io/camera_chip.hpp"
#include "esi/io/read_options.hpp"

namespace esi {

inline constexpr std::string_view kAedat1Magic = "#!AER-DAT1.";
inline constexpr std::string_view kAedat2Magic = "#!AER-DAT2.";

/// The camera of an AEDAT 2 file.
struct Aedat2Camera {
  CameraChip chip;
  SensorSize sensor;               ///< the chip's, or with --chip what --size says
  std::vector<std::string> notes;  ///< what was assumed
};

/// Takes the header, and decides from it, from the options and, where neither names a chip, from the first
/// addresses which camera it is. Throws an Error when the header is cut or of another version, a usage Error
/// that asks for --chip when the chip is unknown.
Aedat2Camera read_aedat2_header(ByteWindow& bytes, const ReadOptions& options);

}  // namespace esi
