#include "esi/pipeline/evaluation/requirement.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "pipeline/evaluation/made_runs.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

namespace {

const std::vector<Detection> kFound = {tag_at(0, 10)};

/// esi finds 1 of 2 in a and 2 of 2 in b, other nothing; a third phase has no frames.
std::vector<InputRun> inputs() {
  return {
      made_input("rec", {{"a", {0, 20'000}}, {"b:c", {20'000, 40'000}}, {"late", {90'000, 99'000}}}, {0},
                 {made_run("esi", 0, {kFound, {}, kFound, kFound}), made_run("other", 0, {{}, {}, {}, {}})})};
}

EvalConfig config() {
  EvalConfig config;
  config.set_json(
      {{"methods", {{{"label", "esi"}, {"method", "esi"}}, {{"label", "other"}, {"method", "accumulator"}}}}},
      "test");
  return config;
}

std::vector<std::string> missed_by(const std::string& text, std::vector<InputRun> runs = inputs()) {
  Evaluation evaluation;
  evaluation.inputs = std::move(runs);
  return missed(parse_requirement(text), results_of(evaluation, {}));
}

}  // namespace

TEST_CASE("a requirement has a name and a rate, and nothing else is taken") {
  const Requirement requirement = parse_requirement("esi:landing>=0.5");
  CHECK(requirement.name == "esi:landing");
  CHECK(requirement.least == 0.5);
  CHECK(parse_requirement("a>=b>=1").name == "a>=b");
  CHECK(parse_requirement("total>=0").least == 0.0);
  const auto bad = GENERATE("", "total", ">=0.5", "total>0.5", "total>=", "total>=x", "total>=0.5x",
                            "total>=1.01", "total>=-0.1", "total>=nan", "total>=80 %", "total >= 0.8");
  CHECK_THROWS_WITH(parse_requirement(bad), Contains("such as total>=0.8"));
}

TEST_CASE("a requirement is missed by each method below it, and not by one that reaches it exactly") {
  CHECK(missed_by("a>=0.5") == std::vector<std::string>{"a>=0.5 is missed by other on rec: 0.0000"});
  CHECK(missed_by("a>=0.51").size() == 2);
  CHECK(missed_by("esi:a>=0.5").empty());
  CHECK(missed_by("esi:a>=0.51") == std::vector<std::string>{"esi:a>=0.51 is missed by esi on rec: 0.5000"});
  CHECK(missed_by("esi:total>=0.75").empty());
  CHECK(missed_by("esi:total>=0.76").size() == 1);
  CHECK(missed_by("esi:b:c>=1").empty());
  CHECK(missed_by("b:c>=1").size() == 1);
  CHECK(missed_by("a>=0").empty());
}

TEST_CASE("a phase without frames misses whatever is required") {
  CHECK(missed_by("esi:late>=0") ==
        std::vector<std::string>{"esi:late>=0 is missed by esi on rec: no frames"});
}

TEST_CASE("of several inputs, what they reach together counts, or each where they can't be pooled") {
  const auto input = [](const std::string& path, int id, std::vector<Detection> tags) {
    return made_input(path, {{"a", {0, 10'000}}}, {id}, {made_run("esi", 0, {std::move(tags)})});
  };
  CHECK(missed_by("a>=0.5", {input("x", 0, {}), input("y", 0, kFound)}).empty());
  CHECK(missed_by("a>=0.6", {input("x", 0, {}), input("y", 0, kFound)}) ==
        std::vector<std::string>{"a>=0.6 is missed by esi on all inputs together: 0.5000"});
  CHECK(missed_by("a>=0.5", {input("x", 0, kFound), input("y", 1, kFound)}) ==
        std::vector<std::string>{"a>=0.5 is missed by esi on y: 0.0000"});
}

TEST_CASE("a requirement of a phase or method that isn't there is refused") {
  const auto runs = inputs();
  for (const char* const known : {"a>=1", "b:c>=1", "esi:b:c>=1", "other:total>=1", "total>=1"}) {
    CHECK_NOTHROW(require_known(parse_requirement(known), runs, config()));
  }
  for (const char* const unknown : {"b>=1", "highpass:a>=1", "esi>=1", "esi:>=1", "A>=1"}) {
    CHECK_THROWS_WITH(require_known(parse_requirement(unknown), runs, config()),
                      Contains("there is no such phase or method"));
  }
}
