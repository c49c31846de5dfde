// Several inputs scored as one.
#include "esi/pipeline/evaluation/pooling.hpp"

#include <catch2/catch.hpp>

#include "pipeline/evaluation/made_runs.hpp"

using namespace esi;
using namespace esi::test;

namespace {

const std::vector<Detection> kFound = {tag_at(0, 10)};
const std::vector<Detection> kForeign = {tag_at(7, 10)};

const PhaseScore& phase_of(const Score& score, const std::string& name) {
  for (const PhaseScore& phase : score.phases) {
    if (phase.name == name) return phase;
  }
  FAIL("no phase " + name);
  return score.total;
}

}  // namespace

TEST_CASE("phases of one name are one, and the total is of all, on whatever clocks") {
  const std::vector<InputRun> inputs = {
      made_input("a", {{"straight", {0, 20'000}}, {"landing", {20'000, 40'000}}}, {0},
                 {made_run("esi", 0, {kFound, {}, kFound, kFound})}),
      // Another clock, another order, a phase of its own.
      made_input("b", {{"landing", {5'000'000, 5'030'000}}, {"turning", {5'030'000, 5'050'000}}}, {0},
                 {made_run("esi", 5'000'000, {{}, kFound, kForeign, {}, kFound})})};
  const auto pooled = pooled_scores(inputs, {});
  REQUIRE(pooled.size() == 1);
  CHECK(pooled[0].first == "esi");
  const Score& score = pooled[0].second;
  REQUIRE(score.phases.size() == 3);
  const auto counts = [](const PhaseScore& phase) { return std::pair(phase.frames.hits, phase.frames.of); };
  CHECK(counts(phase_of(score, "straight")) == std::pair<std::int64_t, std::int64_t>(1, 2));
  CHECK(counts(phase_of(score, "landing")) == std::pair<std::int64_t, std::int64_t>(3, 5));
  CHECK(counts(phase_of(score, "turning")) == std::pair<std::int64_t, std::int64_t>(1, 2));
  CHECK(counts(score.total) == std::pair<std::int64_t, std::int64_t>(5, 9));
  CHECK(phase_of(score, "landing").wrong.foreign == 1);
  CHECK(score.total.wrong.total() == 1);
  CHECK(phase_of(score, "landing").duration_us == 50'000);
  CHECK(score.total.duration_us == 90'000);
}

TEST_CASE("an input split in two scores as the whole does") {
  const auto whole = made_input("whole", {{"a", {0, 60'000}}}, {0},
                                {made_run("esi", 0, {{}, kFound, kFound, {}, kForeign, kFound})});
  const std::vector<InputRun> halves = {
      made_input("first", {{"a", {0, 30'000}}}, {0}, {made_run("esi", 0, {{}, kFound, kFound})}),
      made_input("second", {{"a", {30'000, 60'000}}}, {0},
                 {made_run("esi", 30'000, {{}, kForeign, kFound})})};
  const Score one = score(whole.truth.truth.phases, whole.truth.expected, nullptr, whole.methods[0].frames);
  const Score two = pooled_scores(halves, {}).front().second;
  CHECK(two.total.frames.hits == one.total.frames.hits);
  CHECK(two.total.frames.of == one.total.frames.of);
  CHECK(two.total.wrong.foreign == one.total.wrong.foreign);
  CHECK(two.total.tags.longest_gap_us == one.total.tags.longest_gap_us);
  CHECK(two.total.tags.first_found_us == one.total.tags.first_found_us);
}

TEST_CASE("corners of one input say nothing about another, however far beyond its phases they reach") {
  // Corners stand at 10 px in the first and at 60 px in the second; the first has them for 40 s after its
  // only phase, the second for 40 s before.
  auto first = made_input("first", {{"a", {0, 30'000}}}, {0}, {made_run("esi", 0, {kFound, kFound, kFound})});
  add_corners(first, 0, 10, 0, 40'000'000);
  auto second = made_input("second", {{"a", {40'000'000, 40'030'000}}}, {0},
                           {made_run("esi", 40'000'000, {{tag_at(0, 60)}, {tag_at(0, 60)}, kFound})});
  add_corners(second, 0, 60, 3, 40'030'003);
  std::vector<InputRun> inputs;
  inputs.push_back(std::move(first));
  inputs.push_back(std::move(second));
  const Score score = pooled_scores(inputs, {}).front().second;
  CHECK(score.total.frames.hits == 5);
  CHECK(score.total.wrong.misplaced == 1);
  CHECK(score.total.tags.unverified == 0);
}

TEST_CASE("frames outside of phases are counted, and judged nowhere") {
  const std::vector<InputRun> inputs = {
      made_input("a", {{"a", {10'000, 20'000}}, {"b", {30'000, 40'000}}}, {0},
                 {made_run("esi", 0, {kFound, kFound, kFound, kFound, kFound, kFound})}),
      made_input("b", {{"a", {0, 10'000}}}, {0}, {made_run("esi", 0, {{}, kFound})})};
  const Score score = pooled_scores(inputs, {}).front().second;
  CHECK(score.frames_outside == 5);  // before, between, and twice after; and once after b's
  CHECK(score.total.frames.of == 3);
  CHECK(score.total.frames.hits == 2);
}

TEST_CASE("what can't be compared is not pooled") {
  const auto input = [](const std::string& path, int id, const std::string& label) {
    return made_input(path, {{"a", {0, 10'000}}}, {id}, {made_run(label, 0, {kFound})});
  };
  CHECK(pooled_scores({input("a", 0, "esi")}, {}).empty());
  CHECK(pooled_scores({input("a", 0, "esi"), input("b", 1, "esi")}, {}).empty());
  CHECK(pooled_scores({input("a", 0, "esi"), input("b", 0, "frames")}, {}).empty());
  auto with_corners = input("a", 0, "esi");
  add_corners(with_corners, 0, 10, 0, 20'000);
  CHECK(pooled_scores({with_corners, input("b", 0, "esi")}, {}).empty());
  CHECK(pooled_scores({input("a", 0, "esi"), input("b", 0, "esi")}, {}).size() == 1);
}
