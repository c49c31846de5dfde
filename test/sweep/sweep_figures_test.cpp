#include "esi/sweep/sweep_figures.hpp"

#include <catch2/catch.hpp>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "sweep/made_sweep.hpp"

using namespace esi;
using namespace esi::test;

namespace {

pugi::xml_document parsed(const SweepFigure& figure) {
  pugi::xml_document document;
  REQUIRE(document.load_string(figure.svg.str().c_str()));
  return document;
}

std::vector<std::string> texts(const SweepFigure& figure) {
  std::vector<std::string> found;
  const pugi::xml_document document = parsed(figure);
  for (const auto& node : document.select_nodes("//text")) found.emplace_back(node.node().text().get());
  return found;
}

bool has_text(const SweepFigure& figure, const std::string& text) {
  const auto all = texts(figure);
  return std::find(all.begin(), all.end(), text) != all.end();
}

std::vector<std::string> names(const std::vector<SweepFigure>& figures) {
  std::vector<std::string> found;
  for (const SweepFigure& figure : figures) found.push_back(figure.name);
  return found;
}

/// Of the line of one colour, left to right, in px from the top.
std::vector<double> heights(const SweepFigure& figure, std::size_t series) {
  std::vector<double> found;
  const auto document = parsed(figure);
  const std::string query = "//polyline[@stroke='" + std::string(series_colour(series)) + "'][1]";
  std::istringstream points(document.select_node(query.c_str()).node().attribute("points").value());
  char comma = 0;
  for (double x = 0, y = 0; points >> x >> comma >> y;) found.push_back(y);
  return found;
}

/// The values in a heat map's cells, row by row from above.
std::vector<std::string> values_in(const SweepFigure& figure, std::size_t count) {
  // The label stands first; then in each row its name and its cells.
  const auto all = texts(figure);
  return {all.begin() + 1, all.begin() + 1 + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

TEST_CASE("every axis with several values has curves of phases, of all, and of the best of each value") {
  const auto figures = curve_figures(usual_sweep());
  CHECK(names(figures) == std::vector<std::string>{"tau_s", "form", "readout_decay"});
  const pugi::xml_document document = parsed(figures[0]);
  // straight, the evil one, total and the best with this value; none of the phase without frames
  CHECK(document.select_nodes("//polyline").size() == 2 * 4);  // and in the legend
  CHECK(document.select_nodes("//polyline[@stroke-dasharray]").size() == 2);
  CHECK(document.select_nodes("//polygon").size() == 3);
  CHECK(document.select_nodes("//circle").size() == 3 * 4);
  for (const char* const text :
       {"tau_s (s)", "0.5", "1", "2", "4", "rate, %", "straight", "total", "best with this value"}) {
    CHECK(has_text(figures[0], text));
  }
  CHECK_FALSE(has_text(figures[0], "never"));
  CHECK_FALSE(has_text(figures[0], "3"));
  CHECK(has_text(figures[1], "exponential"));
  CHECK(has_text(figures[1], "power"));
}

TEST_CASE("a curve is of the slice through the best cell, the last one of the best with each value") {
  const SweepFigure figure = curve_figures(usual_sweep()).front();
  const std::vector<double> total = heights(figure, 2), best = heights(figure, 3),
                            straight = heights(figure, 0);
  REQUIRE(total.size() == 4);
  // One scale: total is 0.551, 0.701, 0.861, 0.863, best 0.691, 0.721, 0.861, 0.863 (straight + 5
  // points).
  const double px_per_share = (total[0] - total[1]) / 0.15;
  CHECK((total[0] - total[2]) / px_per_share == Approx(0.31).margin(1e-3));
  CHECK((total[0] - straight[0]) / px_per_share == Approx(0.05).margin(1e-3));
  CHECK((total[0] - best[0]) / px_per_share == Approx(0.14).margin(1e-3));
  CHECK((total[1] - best[1]) / px_per_share == Approx(0.02).margin(1e-3));
  CHECK(total[2] == best[2]);
  CHECK(total[3] == best[3]);
}

TEST_CASE("the best with each value is of the phase that decides") {
  SweepOutcome outcome = usual_sweep();
  outcome.objective = "straight";
  const SweepFigure figure = curve_figures(outcome).front();
  CHECK(heights(figure, 3)[3] == heights(figure, 0)[3]);
  CHECK_THAT(figure.caption, Catch::Contains("the highest rate in straight of"));
}

TEST_CASE("bands are the bootstrap's intervals") {
  const SweepOutcome outcome = made_sweep({made_numbers("n", "", {"1", "2"})},
                                          [](const auto&, std::size_t) { return 501; }, {"a", "never"});
  const auto document = parsed(curve_figures(outcome).front());
  // 0.5005 in all: 0.4705 to 0.5405, on an axis of 46 to 56 % between 274 and 12 px
  const std::string points = document.select_nodes("//polygon")[0].node().attribute("points").value();
  double x = 0, low_px = 0, high_px = 0;
  REQUIRE(std::sscanf(points.c_str(), "%lf,%lf", &x, &low_px) == 2);
  REQUIRE(std::sscanf(points.c_str() + points.find_last_of(' ', points.size() - 2), " %lf,%lf", &x,
                      &high_px) == 2);
  const double dot_px = document.select_nodes("//circle")[0].node().attribute("cy").as_double();
  CHECK((high_px - dot_px) / (dot_px - low_px) == Approx(4.0 / 3.0).margin(0.01));
}

TEST_CASE("axes of far apart values are logarithmic, and numbers ascend however they were given") {
  const auto hits = [](const auto& position, std::size_t) { return 500 + 10 * std::int64_t(position[0]); };
  const auto dots = [&](SweepAxis axis) {
    std::vector<double> x;
    const auto document = parsed(curve_figures(made_sweep({std::move(axis)}, hits)).front());
    for (const auto& node : document.select_nodes("//circle"))
      x.push_back(node.node().attribute("cx").as_double());
    x.resize(3);
    return x;
  };
  const auto wide = dots(made_numbers("n", "", {"100", "1", "10"}));
  CHECK(wide[1] - wide[0] == Approx(wide[2] - wide[1]).margin(0.02));
  CHECK(wide[0] < wide[1]);
  const auto narrow = dots(made_numbers("n", "", {"1", "2", "4"}));
  CHECK(narrow[2] - narrow[1] == Approx(2.0 * (narrow[1] - narrow[0])).margin(0.02));
  SweepAxis asked = made_numbers("n", "", {"1", "2", "4"});
  asked.is_logarithmic = true;
  const auto logarithmic = dots(asked);
  CHECK(logarithmic[2] - logarithmic[1] == Approx(logarithmic[1] - logarithmic[0]).margin(0.02));
}

TEST_CASE("every pair has a heat map of the best rates over the others, in all and each phase") {
  const auto figures = heat_map_figures(usual_sweep());
  REQUIRE(figures.size() == 3 * 3);
  CHECK(figures[0].name == "tau_s-form");
  CHECK(figures[1].name == "tau_s-form-1-straight");
  CHECK(figures[2].name == "tau_s-form-2-a--b---script-alert--x----script----50--");
  const auto all = names(figures);
  CHECK(std::set<std::string>(all.begin(), all.end()).size() == all.size());
  // x: tau, y: form; readout_decay true is the better one by 0.2 points
  CHECK(values_in(figures[0], 10) == std::vector<std::string>{"exponential", "55.1", "70.1", "86.1", "86.3",
                                                              "power", "69.1", "72.1", "74.1", "74.3"});
  CHECK(values_in(figures[1], 5) == std::vector<std::string>{"exponential", "60.1", "75.1", "91.1", "91.3"});
  CHECK_THAT(figures[0].caption, Catch::Contains("the best rate over the values of readout_decay."));
  CHECK(has_text(figures[0], "rate in total, %"));
  CHECK(left_out_heat_maps(usual_sweep()).empty());
}

TEST_CASE("the best cell is outlined in a heat map, and no other of the same rate") {
  const auto figures =
      heat_map_figures(made_sweep({made_numbers("a", "", {"3", "1"}), made_numbers("b", "", {"1", "2"})},
                                  [](const auto&, std::size_t) { return 500; }));
  const auto document = parsed(figures[0]);
  const auto outlines = document.select_nodes("//rect[@fill='#d55e00']");
  REQUIRE(outlines.size() == 1);
  // Cell 0 has a = 3, which stands in the right column, and b = 1, above.
  const auto cells = document.select_nodes("//rect[@fill!='#d55e00']");
  REQUIRE(cells.size() == 4);
  CHECK(outlines[0].node().attribute("x").as_double() + 2.0 == cells[1].node().attribute("x").as_double());
  CHECK(outlines[0].node().attribute("y").as_double() + 2.0 == cells[1].node().attribute("y").as_double());
}

TEST_CASE("cells that the search dropped show their difference to the best, and don't hide whole ones") {
  SweepOutcome outcome = usual_sweep();
  // tau 0.5: all four; tau 1: the better exponential one, whose raw rate would now be the highest there.
  for (const std::size_t cell : {0U, 1U, 2U, 3U, 4U}) drop(outcome, cell, 1);
  const SweepFigure map = heat_map_figures(outcome)[0];
  CHECK(values_in(map, 10) == std::vector<std::string>{"exponential", "55.1", "69.9", "86.1", "86.3", "power",
                                                       "69.1", "72.1", "74.1", "74.3"});
  const auto whole = heights(curve_figures(usual_sweep())[0], 2),
             dropped = heights(curve_figures(outcome)[0], 2);
  // The other phases' own rates make another scale.
  const auto ratio = [](const auto& px) { return (px[0] - px[1]) / (px[1] - px[3]); };
  CHECK(ratio(dropped) == Approx(ratio(whole)).margin(0.01));
}

TEST_CASE("where there would be too many heat maps they are of all phases, and that is said") {
  std::vector<SweepAxis> axes;
  for (const char* const name : {"a", "b", "c", "d", "e", "f", "g"}) {
    axes.push_back(made_numbers(name, "", {"1", "2"}));
  }
  const auto hits = [](const auto& position, std::size_t) { return 500 + std::int64_t(position[0]); };
  CHECK(heat_map_figures(made_sweep(axes, hits)).size() == 21);
  CHECK_THAT(left_out_heat_maps(made_sweep(axes, hits)), Catch::Contains("more than 60"));
  axes.pop_back();
  CHECK(heat_map_figures(made_sweep(axes, hits)).size() == 15 * 3);
  CHECK(left_out_heat_maps(made_sweep(axes, hits)).empty());
}

TEST_CASE("an axis of more values than a heat map shows has none, and that is said") {
  SweepAxis many{"many", "", {}, {}, false};
  for (int i = 0; i < 51; ++i) many.values.push_back(std::to_string(i)), many.numbers.push_back(i);
  const SweepOutcome outcome =
      made_sweep({many, made_numbers("n", "", {"1", "2"})}, [](const auto&, std::size_t) { return 500; });
  CHECK(heat_map_figures(outcome).empty());
  CHECK_THAT(left_out_heat_maps(outcome), Catch::Contains("many, which has more than 50"));
  CHECK(curve_figures(outcome).size() == 2);
}

TEST_CASE("names of files hold nothing but letters, digits, dashes and dots") {
  CHECK(figure_name("a/b\\c d\n<e>_f-g.h\xc3\xa9") == "a-b-c-d--e-_f-g.h--");
  CHECK(figure_name(std::string(99, 'a')).size() == 40);
}
