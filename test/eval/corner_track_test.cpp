#include "esi/eval/corner_track.hpp"

#include <catch2/catch.hpp>

using namespace esi;

namespace {

TrueCorners row(std::int64_t t_us, int id, double x, bool visible = true) {
  return {t_us, id, visible, {x, 1, x + 2, 3, 4, 5, 6, 7}};
}

}  // namespace

TEST_CASE("Corners lie linearly between the rows, exactly on them") {
  const CornerTrack track(std::vector{row(20'000, 0, 20), row(10'000, 0, 10), row(10'000, 5, -1)});
  CHECK(track.at(0, 10'000)->xy_px == row(0, 0, 10).xy_px);
  CHECK(track.at(0, 20'000)->xy_px == row(0, 0, 20).xy_px);
  CHECK(track.at(0, 12'500)->xy_px[0] == Approx(12.5));
  CHECK(track.at(0, 12'500)->xy_px[2] == Approx(14.5));
  CHECK(track.at(0, 12'500)->xy_px[7] == 7.0);
  CHECK(track.at(5, 10'000)->xy_px[0] == -1.0);
  CHECK(track.ids() == std::vector{0, 5});
}

TEST_CASE("Nothing is said outside the rows, in gaps, and of other ids") {
  const CornerTrack track(std::vector{row(10'000, 0, 10), row(60'000, 0, 20), row(110'001, 0, 30)});
  CHECK_FALSE(track.at(0, 9'999));
  CHECK_FALSE(track.at(0, 110'002));
  CHECK_FALSE(track.at(1, 10'000));
  CHECK(track.at(0, 59'999));
  CHECK_FALSE(track.at(0, 60'001));
  CHECK(track.at(0, 110'001));
}

TEST_CASE("A tag is visible between two rows where it is in both") {
  const CornerTrack track(std::vector{row(0, 0, 1), row(10, 0, 1), row(20, 0, 1, false), row(30, 0, 1)});
  CHECK(track.at(0, 5)->visible);
  CHECK(track.at(0, 10)->visible);
  CHECK_FALSE(track.at(0, 15)->visible);
  CHECK_FALSE(track.at(0, 20)->visible);
  CHECK_FALSE(track.at(0, 25)->visible);
}

TEST_CASE("A row that is there twice is refused") {
  CHECK_THROWS_WITH(CornerTrack(std::vector{row(10, 3, 1), row(10, 3, 2)}), Catch::Contains("tag 3"));
}
