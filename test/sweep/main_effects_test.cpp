#include "esi/sweep/main_effects.hpp"

#include <catch2/catch.hpp>

#include "sweep/made_sweep.hpp"

using namespace esi;
using namespace esi::test;
using Sentences = std::vector<std::string>;

namespace {

/// One axis, its values' rates in tenths of a percent; every interval is the difference -+ `half_points`.
std::string effect_of(SweepAxis axis, const std::vector<std::int64_t>& hits, double half_points = 0.5) {
  SweepOutcome outcome =
      made_sweep({std::move(axis)}, [&](const auto& position, std::size_t) { return hits[position[0]]; });
  for (CellOutcome& cell : outcome.cells) {
    if (cell.cell == outcome.best) continue;
    const double difference = *cell.to_best.difference;
    cell.to_best.bootstrap =
        ConfidenceInterval{difference - half_points / 100, difference + half_points / 100};
  }
  const Sentences sentences = main_effects(outcome);
  REQUIRE(sentences.size() == 1);
  return sentences.front();
}

SweepAxis taus(std::vector<std::string> values) { return made_numbers("tau_s", "s", std::move(values)); }

}  // namespace

TEST_CASE("every axis with several values has its sentences, and says where another can make up for it") {
  CHECK(main_effects(usual_sweep()) ==
        Sentences{
            "tau_s matters: below 2 s it costs up to 31.2 points (0.5 s: -31.2, 95 % -31.7 to -30.7); from "
            "2 s on no difference is told. The best, 4 s, is the largest value tried: the best may lie "
            "beyond it. With the other parameters chosen anew 0.5 s costs 17.2 points.",
            "form matters: power costs 12.0 points (-12.0, 95 % -12.5 to -11.5); exponential is best.",
            "readout_decay does not matter (true, false): within 0.2 points."});
}

TEST_CASE("a value costs where it is surely worse, by a point at least") {
  CHECK(effect_of(taus({"1", "2", "4"}), {700, 800, 750}) ==
        "tau_s matters: below 2 s it costs 10.0 points (1 s: -10.0, 95 % -10.5 to -9.5); above 2 s it "
        "costs 5.0 points (4 s: -5.0, 95 % -5.5 to -4.5); 2 s is best.");
  CHECK(effect_of(taus({"1", "2", "4"}), {796, 800, 791}) ==
        "tau_s does not matter between 1 s and 4 s: within 0.9 points.");
  CHECK(effect_of(taus({"1", "2", "4"}), {796, 800, 770}, 4.0) ==
        "tau_s: no difference is told between 1 s and 4 s (the largest is at 4 s: -3.0, 95 % -7.0 to "
        "1.0); more frames may tell one.");
}

TEST_CASE("values without a difference around the best one are named by their ends") {
  CHECK(effect_of(taus({"1", "2", "4", "8", "16"}), {700, 798, 800, 797, 750}) ==
        "tau_s matters: below 2 s it costs 10.0 points (1 s: -10.0, 95 % -10.5 to -9.5); above 8 s it "
        "costs 5.0 points (16 s: -5.0, 95 % -5.5 to -4.5); between 2 s and 8 s no difference is told.");
  CHECK(effect_of(taus({"1", "2", "4"}), {799, 800, 750}) ==
        "tau_s matters: above 2 s it costs 5.0 points (4 s: -5.0, 95 % -5.5 to -4.5); up to 2 s no "
        "difference is told.");
  CHECK(effect_of(taus({"1", "2", "4"}), {800, 799, 750}) ==
        "tau_s matters: above 2 s it costs 5.0 points (4 s: -5.0, 95 % -5.5 to -4.5); up to 2 s no "
        "difference is told. The best, 1 s, is the smallest value tried: the best may lie beyond it.");
}

TEST_CASE("a value beyond a costly one that costs nothing is named, too") {
  CHECK(effect_of(taus({"1", "2", "4", "8"}), {795, 700, 650, 800}) ==
        "tau_s matters: below 8 s it costs up to 15.0 points (4 s: -15.0, 95 % -15.5 to -14.5); 8 s is "
        "best; at 1 s no difference is told either. The best, 8 s, is the largest value tried: the best "
        "may lie beyond it.");
}

TEST_CASE("numbers are told in ascending order, however they were given") {
  CHECK(effect_of(taus({"4", "1", "10"}), {800, 700, 799}) ==
        "tau_s matters: below 4 s it costs 10.0 points (1 s: -10.0, 95 % -10.5 to -9.5); from 4 s on no "
        "difference is told.");
}

TEST_CASE("names have no order: each that costs is told") {
  CHECK(effect_of(made_names("form", {"a", "b", "c", "d"}), {700, 800, 795, 600}) ==
        "form matters: a costs 10.0 points (-10.0, 95 % -10.5 to -9.5); d costs 20.0 points (-20.0, 95 % "
        "-20.5 to -19.5); b is best, no difference is told of c.");
}

TEST_CASE("values with too few frames for an interval are said to have them") {
  SweepOutcome outcome = made_sweep({taus({"1", "2", "4"})}, [](const auto& position, std::size_t) {
    return position[0] == 0 ? 700 : 800;
  });
  outcome.cells[2].to_best.bootstrap.reset();
  CHECK(main_effects(outcome).front() ==
        "tau_s matters: below 2 s it costs 10.0 points (1 s: -10.0, 95 % -10.5 to -9.5); from 2 s on no "
        "difference is told. Too few frames to tell: 4 s.");
  outcome.cells[0].to_best = {};
  CHECK(main_effects(outcome).front() == "tau_s: too few frames to tell.");
}

TEST_CASE("other parameters may make up for all of a value's cost") {
  const SweepOutcome outcome = made_sweep({taus({"1", "2"}), made_numbers("n", "", {"1", "2"})},
                                          [](const auto& position, std::size_t) {
                                            constexpr std::int64_t hits[2][2] = {{700, 799}, {800, 600}};
                                            return hits[position[0]][position[1]];
                                          });
  CHECK_THAT(main_effects(outcome).front(),
             Catch::EndsWith("With the other parameters chosen anew no difference is told at 1 s."));
}

TEST_CASE("a sweep of one cell has no effects") {
  CHECK(main_effects(made_sweep({taus({"1"})}, [](const auto&, std::size_t) { return 500; })).empty());
}
