#include <catch2/catch.hpp>
#include <cmath>
#include <pugixml.hpp>
#include <string>

#include "esi/report/chart.hpp"
#include "esi/report/heat_map.hpp"
#include "esi/report/timeline.hpp"

using namespace esi;

namespace {

pugi::xml_document parsed(const Svg& svg) {
  pugi::xml_document document;
  REQUIRE(document.load_string(svg.str().c_str()));
  return document;
}

std::size_t count(const pugi::xml_document& document, const std::string& element) {
  return document.select_nodes(("//" + element).c_str()).size();
}

std::vector<double> tick_values(const Axis& axis, int count) {
  std::vector<double> values;
  for (const AxisTick& tick : ticks(axis, count)) values.push_back(tick.value);
  return values;
}

bool has_text(const pugi::xml_document& document, const std::string& text) {
  for (const auto& found : document.select_nodes("//text")) {
    if (found.node().text().get() == text) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("an axis has round ends around its values, and round ticks") {
  const Axis axis = axis_around("x", {0.13, 4.2, NAN, INFINITY, 2.0});
  CHECK(axis.low == Approx(0.0));
  CHECK(axis.high == Approx(5.0));
  CHECK(axis.share_of(1.25) == Approx(0.25));
  CHECK(tick_values(axis, 5) == std::vector<double>{0, 1, 2, 3, 4, 5});
  CHECK(ticks({"x", 0.0, 0.3, false}, 3).size() == 4);
}

TEST_CASE("a logarithmic axis has powers of ten, and is linear where a value is not positive") {
  const Axis axis = axis_around("x", {0.5, 200.0}, true);
  CHECK(axis.is_logarithmic);
  CHECK(axis.share_of(10.0) == Approx(0.5));
  CHECK(tick_values(axis, 5) == std::vector<double>{1, 10, 100});
  CHECK(tick_values({"x", 0.5, 4.0, true}, 5) == std::vector<double>{0.5, 1, 2});
  CHECK_FALSE(axis_around("x", {0.0, 10.0}, true).is_logarithmic);
}

TEST_CASE("an axis of one value or none still has a length") {
  for (const std::vector<double>& values : {std::vector<double>{}, {3.0}, {NAN}}) {
    for (const bool logarithmic : {false, true}) {
      const Axis axis = axis_around("x", values, logarithmic);
      CHECK(axis.low < axis.high);
      CHECK(std::isfinite(axis.share_of(3.0)));
    }
  }
}

TEST_CASE("a line chart has a line per series, broken where a value is missing, its band and a legend") {
  const Axis x = axis_around("tau (s)", {1, 5}), y = axis_around("rate", {0, 1});
  const Series whole{"esi", {1, 2, 3, 4}, {0.1, 0.2, 0.3, 0.4}, {0, 0.1, 0.2, 0.3}, {0.2, 0.3, 0.4, 0.5},
                     true};
  const Series broken{"b", {1, 2, 3, 4, 5}, {0.1, 0.2, NAN, 0.4, 0.5}, {}, {}, false};
  const auto document = parsed(line_chart(x, y, {whole, broken}));
  CHECK(count(document, "polyline") == 3 + 2);  // and in the legend
  CHECK(count(document, "polygon") == 1);
  CHECK(count(document, "circle") == 4);
  CHECK(has_text(document, "esi"));
  CHECK(has_text(document, "tau (s)"));
  CHECK_FALSE(has_text(parsed(line_chart(x, y, {whole})), "esi"));
}

TEST_CASE("bars are as long as their values") {
  const auto document =
      parsed(bar_chart({"ms", 0, 10, false}, {{"a", 5.0, "5 ms"}, {"b", 10.0, "10 ms"}, {"c", 0.0, ""}}));
  const auto bars = document.select_nodes("//rect");
  REQUIRE(bars.size() == 3);
  const auto width = [&](std::size_t i) { return bars[i].node().attribute("width").as_double(); };
  CHECK(width(1) == Approx(2.0 * width(0)));
  CHECK(width(2) == Approx(1.0));
  CHECK(has_text(document, "5 ms"));
}

TEST_CASE("a timeline shows hits, misses and nothing where there was no frame") {
  const std::vector<Phase> phases = {{"straight", {0, 5'000'000}}, {"landing", {5'000'000, 10'000'000}}};
  TimelineRow row{"esi", {}, {}};
  for (std::int64_t t_us = 0; t_us < 7'500'000; t_us += 10'000) {
    row.t_us.push_back(t_us);
    row.is_hit.push_back(t_us >= 2'500'000);
  }
  const auto document = parsed(timeline(phases, {row}, 990.0));
  const auto runs = document.select_nodes("//rect");
  REQUIRE(runs.size() == 2);
  const auto of = [&](std::size_t i, const char* name) { return runs[i].node().attribute(name).as_double(); };
  CHECK(of(0, "width") == Approx(200.0).margin(4.0));
  CHECK(of(1, "x") == Approx(170.0 + 200.0).margin(4.0));
  CHECK(of(1, "width") == Approx(400.0).margin(4.0));
  CHECK(std::string(runs[0].node().attribute("fill").value()) == "#e1e1e1");
  CHECK(std::string(runs[1].node().attribute("fill").value()) == "#0072b2");
  CHECK(has_text(document, "straight"));
  CHECK(has_text(document, "landing"));
  CHECK(count(parsed(timeline({}, {})), "rect") == 0);
}

TEST_CASE("a heat map shows every value, and none where there is none") {
  const auto document =
      parsed(heat_map({"tau", "n", "rate", {"1", "2"}, {"a", "b"}, {{0.1, 0.9}, {NAN, 0.5}}}));
  CHECK(count(document, "rect") == 4);  // three values, and the best one's outline
  CHECK(has_text(document, "0.9"));
  CHECK(has_text(document, "-"));
  CHECK(document.select_nodes("//rect[@fill='#08519c']").size() == 1);
}

TEST_CASE("a short logarithmic axis without round numbers in it still has ticks") {
  CHECK(tick_values({"x", 6.0, 9.0, true}, 5) == std::vector<double>{6, 7, 8, 9});
}

TEST_CASE("an axis of names has them side by side, within its ends") {
  const Axis axis = axis_of_names("form", {"linear", "power", "none"});
  CHECK(tick_values(axis, 1) == std::vector<double>{0, 1, 2});
  CHECK(axis.share_of(1.0) == Approx(0.5));
  CHECK(axis.share_of(0.0) == Approx(1.0 / 6.0));
  CHECK(axis_of_names("form", {}).low < axis_of_names("form", {}).high);
  const Series series{"a", {0, 1, 2}, {0, 1, 0}, {}, {}};
  const auto document = parsed(line_chart(axis, {"rate", 0.0, 1.0}, {series}));
  for (const char* const name : {"linear", "power", "none"}) CHECK(has_text(document, name));
  CHECK_FALSE(has_text(document, "2"));
}

TEST_CASE("a dashed line is dashed in its legend, too") {
  const Series plain{"a", {0, 1}, {0, 1}, {}, {}, true, false},
      dashed{"b", {0, 1}, {1, 0}, {}, {}, false, true};
  const auto document = parsed(line_chart({"x"}, {"y"}, {plain, dashed}));
  CHECK(document.select_nodes("//polyline[@stroke-dasharray]").size() == 2);
  CHECK(count(document, "polyline") == 4);
}

TEST_CASE("a legend is as wide as its names, up to a limit") {
  const auto plot_px = [](const std::string& name) {
    const auto document =
        parsed(line_chart({"x"}, {"y"}, {{name, {0, 1}, {0, 1}, {}, {}}, {"b", {0, 1}, {1, 0}, {}, {}}}));
    double right_px = 0.0;
    for (const auto& line : document.select_nodes("//line")) {
      right_px = std::max(right_px, line.node().attribute("x2").as_double());
    }
    return right_px;
  };
  CHECK(plot_px("a") == Approx(640.0 - 16.0 - 150.0));
  CHECK(plot_px(std::string(20, 'a')) == Approx(640.0 - 16.0 - 20 * 7.0 - 52.0));
  CHECK(plot_px(std::string(99, 'a')) == Approx(640.0 - 16.0 - 300.0));
  CHECK(text_width_px("\xc3\xa9\xe2\x82\xac") == Approx(2.0 * text_width_px("a")));
}

TEST_CASE("a heat map outlines the cell it is told to, and is as wide as its names") {
  HeatMap map{"tau", "n", "rate", {"1", "2"}, {"a", "b"}, {{0.9, 0.9}, {0.1, 0.5}}};
  CHECK(parsed(heat_map(map)).select_nodes("//rect[@fill='#d55e00']").size() == 2);
  map.outlined = HeatMap::Place{1, 0};
  const auto document = parsed(heat_map(map));
  const auto outlines = document.select_nodes("//rect[@fill='#d55e00']");
  REQUIRE(outlines.size() == 1);
  CHECK(outlines[0].node().attribute("x").as_double() == Approx(90.0 + 58.0));
  CHECK(outlines[0].node().attribute("y").as_double() == Approx(26.0));
  const double width_px = heat_map(map).width_px();
  map.x[0] = std::string(30, 'x');
  CHECK(heat_map(map).width_px() > width_px + 150.0);
  map.y[0] = std::string(30, 'y');
  CHECK(heat_map(map).width_px() > width_px + 300.0);
}
