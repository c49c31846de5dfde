#pragma once

namespace esi {

/// a . b over `count` entries, always added in the same order.
double dot(const float* a, const float* b, int count);

}  // namespace esi
