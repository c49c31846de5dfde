#pragma once

#include <span>

#include "esi/sim/view.hpp"

namespace esi {

/// The light on one row of pixels: relative intensity, 1 for a white surface. Textures are looked up in the
/// resolution that fits (trilinear), borders are smoothed over a pixel, so nothing aliases.
void render_row(const View& view, int y, std::span<float> light);

}  // namespace esi
