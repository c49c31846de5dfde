#include "esi/eval/score.hpp"

#include <catch2/catch.hpp>

using namespace esi;

namespace {

/// A square tag of 20 px whose lower left corner, the first one, is at (x, y + 20).
std::array<double, 8> square(double x, double y) { return {x, y + 20, x + 20, y + 20, x + 20, y, x, y}; }

Detection tag(int id, double x = 10, double y = 10, int hamming = 0, double margin = 50) {
  return {id, hamming, margin, {x + 10, y + 10}, square(x, y)};
}

FrameDetections frame(std::int64_t t_us, std::vector<Detection> detections = {}) {
  return {t_us / 10'000, t_us, std::move(detections)};
}

TrueCorners truth(std::int64_t t_us, int id, double x = 10, double y = 10, bool visible = true) {
  return {t_us, id, visible, square(x, y)};
}

const std::vector<Phase> kPhases{{"first", {100'000, 200'000}}, {"second", {200'000, 400'000}}};

}  // namespace

TEST_CASE("A frame belongs to the phase whose half-open interval has its time") {
  const std::vector<FrameDetections> frames{frame(99'999, {tag(0)}), frame(100'000, {tag(0)}),
                                            frame(199'999),          frame(200'000, {tag(0)}),
                                            frame(399'999),          frame(400'000, {tag(0)})};
  const Score result = score(kPhases, {{0}}, nullptr, frames);
  REQUIRE(result.phases.size() == 2);
  CHECK(result.phases[0].name == "first");
  CHECK(result.phases[0].frames.hits == 1);
  CHECK(result.phases[0].frames.of == 2);
  CHECK(result.phases[1].frames.hits == 1);
  CHECK(result.phases[1].frames.of == 2);
  CHECK(result.total.name == "total");
  CHECK(result.total.frames.hits == 2);
  CHECK(result.total.frames.of == 4);
  CHECK(result.frames_outside == 2);
  CHECK(result.frames.size() == 4);
}

TEST_CASE("A phase without frames has no rate, but a reason") {
  const std::vector<FrameDetections> frames{frame(150'000, {tag(0)})};
  const Score result = score(kPhases, {{0}}, nullptr, frames);
  CHECK(result.phases[0].reason.empty());
  CHECK(result.phases[0].frames.value() == 1.0);
  const PhaseScore& empty = result.phases[1];
  CHECK(empty.frames.of == 0);
  CHECK_FALSE(empty.frames.value());
  CHECK_FALSE(empty.frames.wilson());
  CHECK_FALSE(empty.bootstrap);
  CHECK(empty.reason == "no frame lies in this phase");
  CHECK_FALSE(empty.tags.first_found_us);
  CHECK(empty.tags.longest_gap_us == 200'000);
  CHECK(score(kPhases, {{0}}, nullptr, {}).total.reason == "no frame lies in any phase");
}

TEST_CASE("Foreign ids are false and make no frame detected") {
  const std::vector<FrameDetections> frames{frame(100'000, {tag(7)}),
                                            frame(110'000, {tag(0), tag(7), tag(9)})};
  const PhaseScore result = score(kPhases, {{0, 1}}, nullptr, frames).phases[0];
  CHECK(result.frames.hits == 1);
  CHECK(result.wrong.foreign == 3);
  CHECK(result.wrong.total() == 3);
  CHECK(result.tags.instances.hits == 1);
  CHECK(result.tags.instances.of == 4);
}

TEST_CASE("Corners may be 5 px off, in any of the four rotations, but not more and not mirrored") {
  const CornerTrack corners(std::vector{truth(100'000, 0)});
  const auto hits = [&](const std::array<double, 8>& xy_px) {
    Detection found = tag(0);
    found.xy_px = xy_px;
    const std::vector<FrameDetections> frames{frame(100'000, {found})};
    const PhaseScore result = score(kPhases, {{0}}, &corners, frames).phases[0];
    CHECK(result.wrong.misplaced == 1 - result.frames.hits);
    return result.frames.hits;
  };
  CHECK(hits(square(13, 14)) == 1);
  CHECK(hits(square(13, 14.001)) == 0);
  CHECK(hits({30, 30, 30, 10, 10, 10, 10, 30}) == 1);
  CHECK(hits({30, 10, 10, 10, 10, 30, 30, 30}) == 1);
  CHECK(hits({10, 10, 10, 30, 30, 30, 30, 10}) == 1);
  CHECK(hits({30, 30, 10, 30, 10, 10, 30, 10}) == 0);
  auto one_corner = square(10, 10);
  one_corner[5] += 5.001;
  CHECK(hits(one_corner) == 0);
  one_corner[5] = std::numeric_limits<double>::quiet_NaN();
  CHECK(hits(one_corner) == 0);
}

TEST_CASE("The corner error is the mean of the four distances, summed up over the tags found") {
  std::vector<TrueCorners> rows;
  std::vector<FrameDetections> frames;
  const double offsets_px[] = {0, 1, 2, 3, 4};
  for (int k = 0; k < 5; ++k) {
    rows.push_back(truth(100'000 + 10'000 * k, 0));
    frames.push_back(frame(100'000 + 10'000 * k, {tag(0, 10 + offsets_px[k], 10, k == 4 ? 1 : 0, 10.0 * k)}));
  }
  frames[4].detections[0].xy_px[0] = 10;  // one corner without error: the mean is 3
  const CornerTrack corners(rows);
  const TagScore tags = score(kPhases, {{0}}, &corners, frames).phases[0].tags;
  CHECK(tags.corner_error_median_px.value() == Approx(2.0));
  CHECK(tags.corner_error_mean_px.value() == Approx(9.0 / 5));
  CHECK(tags.corner_error_p95_px.value() == Approx(3.0));
  CHECK(tags.margin_median.value() == 20.0);
  CHECK(tags.hamming == std::vector<std::int64_t>{4, 1});
  CHECK(tags.unverified == 0);
}

TEST_CASE("Two tags: a frame counts with one, instances with what truth says is visible") {
  const CornerTrack corners(std::vector{truth(100'000, 0), truth(100'000, 1, 60, 10), truth(110'000, 0),
                                        truth(110'000, 1, 60, 10, false)});
  const std::vector<FrameDetections> frames{frame(100'000, {tag(1, 60, 10)}),
                                            frame(110'000, {tag(1, 60, 10)})};
  const PhaseScore result = score(kPhases, {{0, 1}}, &corners, frames).phases[0];
  CHECK(result.frames.hits == 2);
  CHECK(result.tags.instances.hits == 1);
  CHECK(result.tags.instances.of == 3);
  CHECK(result.by_id.at(0).instances.hits == 0);
  CHECK(result.by_id.at(0).instances.of == 2);
  CHECK_FALSE(result.by_id.at(0).first_found_us);
  CHECK(result.by_id.at(0).longest_gap_us == 100'000);
  CHECK(result.by_id.at(1).instances.hits == 1);
  CHECK(result.by_id.at(1).instances.of == 1);
  CHECK(result.by_id.at(1).first_found_us == 0);
  CHECK(result.by_id.at(1).longest_gap_us == 90'000);
}

TEST_CASE("Of several detections of one id one counts: the nearest, else the surest") {
  const CornerTrack corners(std::vector{truth(100'000, 0)});
  const std::vector<FrameDetections> frames{
      frame(100'000, {tag(0, 13, 10, 0, 90), tag(0, 11, 10, 1, 20), tag(0, 100, 100)})};
  const PhaseScore placed = score(kPhases, {{0}}, &corners, frames).phases[0];
  CHECK(placed.wrong.duplicate == 1);
  CHECK(placed.wrong.misplaced == 1);
  CHECK(placed.tags.corner_error_mean_px == Approx(1.0));
  const std::vector<FrameDetections> loose{
      frame(100'000, {tag(0, 10, 10, 1, 90), tag(0, 50, 10, 0, 20), tag(0, 90, 10, 0, 40)})};
  const PhaseScore unplaced = score(kPhases, {{0}}, nullptr, loose).phases[0];
  CHECK(unplaced.wrong.duplicate == 2);
  CHECK(unplaced.frames.hits == 1);
  CHECK(unplaced.tags.instances.hits == 1);
  CHECK(unplaced.tags.margin_median == 40.0);
  CHECK(unplaced.tags.hamming == std::vector<std::int64_t>{1});
}

TEST_CASE("Where truth has no corners an expected id is enough, and that is counted") {
  const CornerTrack corners(std::vector{truth(100'000, 0)});
  const std::vector<FrameDetections> frames{frame(100'000, {tag(0)}), frame(110'000, {tag(0, 99, 99)})};
  const PhaseScore late = score(kPhases, {{0}}, &corners, frames).phases[0];
  CHECK(late.frames.hits == 2);
  CHECK(late.tags.unverified == 1);
  CHECK(late.tags.instances.of == 1);
  const PhaseScore without = score(kPhases, {{0}}, nullptr, frames).phases[0];
  CHECK(without.tags.unverified == 0);
  CHECK_FALSE(without.tags.corner_error_median_px);
}

TEST_CASE("Without expected ids those with corners are expected, without corners every one") {
  const std::vector<FrameDetections> frames{frame(100'000, {tag(3), tag(500)})};
  const PhaseScore all = score(kPhases, {}, nullptr, frames).phases[0];
  CHECK(all.wrong.total() == 0);
  CHECK(all.frames.hits == 1);
  CHECK(all.tags.instances.of == 0);
  CHECK(all.by_id.size() == 2);
  CHECK(all.by_id.at(500).first_found_us == 0);
  const CornerTrack corners(std::vector{truth(100'000, 3)});
  const PhaseScore known = score(kPhases, {}, &corners, frames).phases[0];
  CHECK(known.wrong.foreign == 1);
  CHECK(known.tags.instances.of == 1);
}

TEST_CASE("First detection and longest gap are measured in the phase, from end to end") {
  const std::vector<FrameDetections> frames{frame(130'000, {tag(0)}), frame(140'000, {tag(0)}),
                                            frame(180'000, {tag(0)}), frame(190'000),
                                            frame(230'000, {tag(0)}), frame(350'000)};
  const Score result = score(kPhases, {{0}}, nullptr, frames);
  CHECK(result.phases[0].tags.first_found_us == 30'000);
  CHECK(result.phases[0].tags.longest_gap_us == 40'000);
  CHECK(result.phases[1].tags.first_found_us == 30'000);
  CHECK(result.phases[1].tags.longest_gap_us == 170'000);
  CHECK(result.total.tags.first_found_us == 30'000);
  CHECK(result.total.tags.longest_gap_us == 170'000);
  CHECK(result.total.duration_us == 300'000);
}

TEST_CASE("What lies between phases takes no time in the total") {
  const std::vector<Phase> apart{{"a", {0, 100'000}}, {"b", {1'000'000, 1'100'000}}};
  const std::vector<FrameDetections> frames{frame(80'000, {tag(0)}), frame(1'030'000, {tag(0)})};
  const PhaseScore total = score(apart, {{0}}, nullptr, frames).total;
  CHECK(total.tags.longest_gap_us == 80'000);
  CHECK(total.tags.first_found_us == 80'000);
  CHECK(total.duration_us == 200'000);
  const std::vector<FrameDetections> later{frame(1'030'000, {tag(0)})};
  CHECK(score(apart, {{0}}, nullptr, later).total.tags.first_found_us == 130'000);
}

TEST_CASE("Frames that don't ascend in time are refused") {
  const std::vector<FrameDetections> frames{frame(110'000), frame(110'000)};
  CHECK_THROWS_WITH(score(kPhases, {{0}}, nullptr, frames), Catch::Contains("not after"));
}

TEST_CASE("Methods are compared on the frames that both have") {
  std::vector<FrameDetections> a, b;
  for (int k = 0; k < 30; ++k) {
    const std::vector<Detection> found{tag(0)};
    a.push_back(frame(100'000 + 10'000 * k, found));
    if (k % 3 != 2) b.push_back(frame(100'000 + 10'000 * k, k % 3 == 0 ? found : std::vector<Detection>{}));
  }
  BootstrapOptions options;
  options.block_s = 0.05;
  const PairedDifference pair =
      paired_difference(score(kPhases, {{0}}, nullptr, a), score(kPhases, {{0}}, nullptr, b), options);
  CHECK(pair.frames == 20);
  CHECK(pair.difference == Approx(0.5));
  REQUIRE(pair.bootstrap);
  CHECK(pair.bootstrap->low <= 0.5);
  CHECK(pair.bootstrap->high >= 0.5);
  CHECK_FALSE(
      paired_difference(score(kPhases, {{0}}, nullptr, a), score(kPhases, {{0}}, nullptr, {})).difference);
}
