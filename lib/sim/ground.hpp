#pragma once

#include <cstdint>

#include "esi/sim/texture.hpp"

namespace esi {

/// Texels are this large; the ground repeats after 2048 of them, 8.2 m.
inline constexpr double kGroundTexel_m = 0.004;

/// Reflectance of ground whose log has a 1/f amplitude spectrum, as natural images have (Field 1987), and the
/// deviation `contrast` (ln units). Kept between a black and a white.
Texture ground_texture(double reflectance, double contrast, std::int64_t seed);

}  // namespace esi
