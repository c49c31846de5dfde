#pragma once

namespace esi {

/// a . b over `count` entries, always added in the same order.
double dot(const float* a, const float* b, int count);

/// A step of conjugate gradients: solution += step direction, residual -= step product. Returns the new
/// residual . inverse_diagonal residual.
double step_along(int count, float step, const float* direction, const float* product,
                  const float* inverse_diagonal, float* solution, float* residual);

}  // namespace esi
