#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace esi {

/// Px, y down.
struct Point {
  double x = 0.0, y = 0.0;
};

/// Where a text's point lies in it.
enum class Anchor { start, middle, end };

/// A drawing in SVG, to stand within an HTML page or as a file of its own. Colours are CSS colours.
class Svg {
 public:
  Svg(double width_px, double height_px);

  void line(Point a, Point b, std::string_view colour, double width_px = 1.0);
  void polyline(const std::vector<Point>& points, std::string_view colour, double width_px = 1.5,
                bool is_dashed = false);
  /// Filled, without a border.
  void polygon(const std::vector<Point>& points, std::string_view colour, double opacity);
  void rectangle(Point corner, double width_px, double height_px, std::string_view colour,
                 std::string_view tooltip = "");
  void circle(Point centre, double radius_px, std::string_view colour);
  void text(Point at, std::string_view text, Anchor anchor = Anchor::start, std::string_view colour = "#222");
  /// Upwards, `at` being its middle.
  void upright_text(Point at, std::string_view text);

  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }

  /// The whole element.
  std::string str() const;

 private:
  double width_px_, height_px_;
  std::string content_;
};

/// About the width of a text in a drawing's font; fonts differ from machine to machine.
double text_width_px(std::string_view text);

/// Eight colours that people with colour blindness can tell apart (Okabe & Ito 2008), again and again.
std::string_view series_colour(std::size_t i);

}  // namespace esi
