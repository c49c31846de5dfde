#include "esi/sim/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "esi/sim/texture_span.hpp"

namespace esi {
namespace {

constexpr float kSky = 0.5F;

/// Columns of a row, half-open.
struct Span {
  int begin, end;
  int length() const { return std::max(0, end - begin); }
};

/// The pixels of a row, of `width`, that are further inside all edges than `inside_px`.
Span span_inside(const std::vector<ProjectedSurface::Edge>& edges, int y, double inside_px, int width) {
  double low = -1.0;
  double high = width;
  for (const auto& edge : edges) {
    const double needed = inside_px - edge.at(0.0, y);  // a x > needed
    if (std::abs(edge.a) < 1e-9) {
      if (needed >= 0.0) return {0, 0};
    } else if (edge.a > 0.0) {
      low = std::max(low, needed / edge.a);
    } else {
      high = std::min(high, needed / edge.a);
    }
  }
  if (!(low < high)) return {0, 0};
  return {static_cast<int>(std::floor(low)) + 1, static_cast<int>(std::ceil(high))};
}

/// The share of a pixel that lies inside: distance to each edge's line, from -0.5 px to 0.5 px.
float coverage(const std::vector<ProjectedSurface::Edge>& edges, int x, int y) {
  double share = 1.0;
  for (const auto& edge : edges) share *= std::clamp(edge.at(x, y) + 0.5, 0.0, 1.0);
  return static_cast<float>(share);
}

/// Pixels that the surface covers in part.
void blend(const ProjectedSurface& surface, Span columns, int y, std::span<float> light) {
  std::array<float, 32> own;
  const int run = static_cast<int>(own.size());
  for (int begin = columns.begin; begin < columns.end; begin += run) {
    const int end = std::min(begin + run, columns.end);
    sample_span(surface, begin, y, std::span(own).first(static_cast<std::size_t>(end - begin)));
    for (int x = begin; x < end; ++x) {
      float& pixel = light[static_cast<std::size_t>(x)];
      pixel += coverage(surface.edges, x, y) * (own[static_cast<std::size_t>(x - begin)] - pixel);
    }
  }
}

void draw(const ProjectedSurface& surface, int y, std::span<float> light) {
  const int width = static_cast<int>(light.size());
  const Span touched = span_inside(surface.edges, y, -0.5, width);
  const Span whole = span_inside(surface.edges, y, 0.5, width);
  if (whole.length() == 0) return blend(surface, touched, y, light);
  blend(surface, {touched.begin, whole.begin}, y, light);
  sample_span(surface, whole.begin, y,
              light.subspan(static_cast<std::size_t>(whole.begin), static_cast<std::size_t>(whole.length())));
  blend(surface, {whole.end, touched.end}, y, light);
}

}  // namespace

void render_row(const View& view, int y, std::span<float> light) {
  std::fill(light.begin(), light.end(), kSky);
  for (const ProjectedSurface& surface : view) draw(surface, y, light);
}

}  // namespace esi
