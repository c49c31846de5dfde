#pragma once

#include <span>

#include "esi/sim/view.hpp"

namespace esi {

/// The texture of a surface at the pixels (x, y), (x + 1, y), ... of a row. All must be in front of the
/// camera.
void sample_span(const ProjectedSurface& surface, int x, int y, std::span<float> light);

}  // namespace esi
