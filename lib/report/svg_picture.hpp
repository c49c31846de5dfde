#pragma once

#include <string>

#include "esi/report/svg.hpp"

namespace esi {

/// The drawing as the bytes of a PNG file, on white, two pixels for each of its own (fewer where it would
/// have more than 50 million). The same drawing gives the same bytes on a machine; fonts differ between
/// machines. Throws an Error where it can't be drawn.
std::string png_of(const Svg& svg);

}  // namespace esi
