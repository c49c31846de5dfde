#include "esi/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/report/escape.hpp"

namespace esi {
namespace {

/// A hundredth of a pixel is enough, and the same text comes out on every machine.
std::string place(double value) { return fmt::format("{:.2f}", value == 0.0 ? 0.0 : value); }

std::string points_text(const std::vector<Point>& points) {
  std::string text;
  for (const Point& point : points) text += place(point.x) + ',' + place(point.y) + ' ';
  return text;
}

std::string_view name_of(Anchor anchor) {
  constexpr std::array<std::string_view, 3> kNames = {"start", "middle", "end"};
  return kNames[static_cast<std::size_t>(anchor)];
}

}  // namespace

Svg::Svg(double width_px, double height_px) : width_px_(width_px), height_px_(height_px) {}

void Svg::line(Point a, Point b, std::string_view colour, double width_px) {
  content_ += fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="{}" stroke-width="{}"/>)",
                          place(a.x), place(a.y), place(b.x), place(b.y), colour, width_px) +
              '\n';
}

void Svg::polyline(const std::vector<Point>& points, std::string_view colour, double width_px,
                   bool is_dashed) {
  const std::string_view dashes = is_dashed ? R"( stroke-dasharray="6 4")" : "";
  content_ += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="{}"{}/>)",
                          points_text(points), colour, width_px, dashes) +
              '\n';
}

void Svg::polygon(const std::vector<Point>& points, std::string_view colour, double opacity) {
  content_ += fmt::format(R"(<polygon points="{}" fill="{}" fill-opacity="{}"/>)", points_text(points),
                          colour, opacity) +
              '\n';
}

void Svg::rectangle(Point corner, double width_px, double height_px, std::string_view colour,
                    std::string_view tooltip) {
  const std::string title = tooltip.empty() ? "" : fmt::format("<title>{}</title>", html_text(tooltip));
  content_ +=
      fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="{}">{}</rect>)", place(corner.x),
                  place(corner.y), place(width_px), place(height_px), colour, title) +
      '\n';
}

void Svg::circle(Point centre, double radius_px, std::string_view colour) {
  content_ += fmt::format(R"(<circle cx="{}" cy="{}" r="{}" fill="{}"/>)", place(centre.x), place(centre.y),
                          radius_px, colour) +
              '\n';
}

void Svg::text(Point at, std::string_view text, Anchor anchor, std::string_view colour) {
  content_ += fmt::format(R"(<text x="{}" y="{}" text-anchor="{}" fill="{}">{}</text>)", place(at.x),
                          place(at.y), name_of(anchor), colour, html_text(text)) +
              '\n';
}

void Svg::upright_text(Point at, std::string_view text) {
  content_ +=
      fmt::format(R"svg(<text transform="translate({} {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                  place(at.x), place(at.y), html_text(text)) +
      '\n';
}

std::string Svg::str() const {
  return fmt::format(
             R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
             R"(font-family="sans-serif" font-size="12">)",
             width_px_, height_px_) +
         '\n' + content_ + "</svg>\n";
}

double text_width_px(std::string_view text) {
  constexpr double kCharacter_px = 7.0;
  // What continues a character of UTF-8 has no width of its own.
  const auto characters = std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
  return kCharacter_px * static_cast<double>(characters);
}

std::string_view series_colour(std::size_t i) {
  constexpr std::array<std::string_view, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                        "#e69f00", "#56b4e9", "#000000", "#b8a800"};
  return kColours[i % kColours.size()];
}

}  // namespace esi
