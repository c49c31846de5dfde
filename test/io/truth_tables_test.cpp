#include "esi/io/truth_tables.hpp"

#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "esi/io/writing/ground_truth_writer.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using esi::test::TempFolder;

namespace {

const std::string kHeader = "t_s,id,visible,x1,y1,x2,y2,x3,y3,x4,y4\n";

template <class Read>
std::string refusal(Read read, const std::string& text) {
  const TempFolder folder;
  try {
    read(folder.write("table", text));
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::usage);
    const std::string what = error.what();
    const std::string name = (folder / "table").string() + ": ";
    CHECK(what.substr(0, name.size()) == name);
    return what.substr(std::min(name.size(), what.size()));
  }
  return "nothing";
}

std::string corners_refusal(const std::string& rows) { return refusal(read_corners, kHeader + rows); }
std::string track_refusal(const std::string& lines) { return refusal(read_track, lines); }

}  // namespace

TEST_CASE("Corners read back as they were written") {
  const TempFolder folder;
  const std::vector<TrueCorners> rows{{-10'000, 0, true, {0.1, 1.0 / 3.0, -5, 1e-9, 346.5, 7, 8, 9}},
                                      {62'123'457, 0, false, {1, 2, 3, 4, 5, 6, 7, 8}},
                                      {62'123'457, 586, true, {-1, -2, -3, -4, -5, -6, -7, -8}}};
  CornersWriter writer(folder / "corners.csv");
  for (const TrueCorners& row : rows) writer.write(row);
  writer.finish();
  const std::vector<TrueCorners> found = read_corners(folder / "corners.csv");
  REQUIRE(found.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(found[i].t_us == rows[i].t_us);
    CHECK(found[i].id == rows[i].id);
    CHECK(found[i].visible == rows[i].visible);
    CHECK(found[i].xy_px == rows[i].xy_px);
  }
}

TEST_CASE("Tracks read back as they were written") {
  const TempFolder folder;
  const std::vector<TrackPose> poses{{-10'000, {1.0 / 3.0, -2, 1e-12}, {0.5, -0.5, 0.5, 0.5}},
                                     {62'123'457, {1, 2, 3}, {0, 0, 0, 1}}};
  TrackWriter writer(folder / "camera.tum");
  for (const TrackPose& pose : poses) writer.write(pose);
  writer.finish();
  const std::vector<TrackPose> found = read_track(folder / "camera.tum");
  REQUIRE(found.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(found[i].t_us == poses[i].t_us);
    CHECK(found[i].position_m == poses[i].position_m);
    CHECK(found[i].quaternion_xyzw == poses[i].quaternion_xyzw);
  }
}

TEST_CASE("Comments, empty lines, blanks, CRLF and a missing last line break are no damage") {
  const TempFolder folder;
  const auto corners =
      folder.write("corners.csv", "\xef\xbb\xbf# made by hand\r\n" + kHeader +
                                      "\n 0.5 , 3,1,1,2,3,4,5,6,7,8\r\n# more\n1,3,0,1,2,3,4,5,6,7,8");
  REQUIRE(read_corners(corners).size() == 2);
  CHECK(read_corners(corners)[0].t_us == 500'000);
  const auto track = folder.write("a.tum", "# t x y z\n\n  0 1 2 3\t0 0 0  1 \r\n0.000001 1 2 3 0 0 0 2");
  REQUIRE(read_track(track).size() == 2);
  CHECK(read_track(track)[1].t_us == 1);
}

TEST_CASE("Damaged corners are refused with the line") {
  using Catch::Contains;
  const std::string good = "0,3,1,1,2,3,4,5,6,7,8\n";
  CHECK_THAT(refusal(read_corners, ""), Contains("there are no corners in it"));
  CHECK_THAT(corners_refusal(""), Contains("there are no corners in it"));
  CHECK_THAT(refusal(read_corners, good), Contains("line 1: it must be the header t_s,id"));
  CHECK_THAT(refusal(read_corners, "id,t_s,visible,x1,y1,x2,y2,x3,y3,x4,y4\n" + good), Contains("line 1"));
  CHECK_THAT(corners_refusal(good + "1,3,1,1,2,3,4,5,6,7\n"),
             Contains("line 3: it is not 11 finite numbers"));
  CHECK_THAT(corners_refusal("1,3,1,1,2,3,4,5,6,7,8,9\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("1;3;1;1;2;3;4;5;6;7;8\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("1,3,1,1,2,3,4,,6,7,8\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("1,3,1,1,2,3,4,nan,6,7,8\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("inf,3,1,1,2,3,4,5,6,7,8\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("1e12,3,1,1,2,3,4,5,6,7,8\n"), Contains("line 2: 1000000000000 s is no time"));
  CHECK_THAT(corners_refusal("1,3,2,1,2,3,4,5,6,7,8\n"), Contains("line 2: visible is 2"));
  CHECK_THAT(corners_refusal("1,3,true,1,2,3,4,5,6,7,8\n"), Contains("line 2: it is not 11"));
  CHECK_THAT(corners_refusal("1,-1,1,1,2,3,4,5,6,7,8\n"), Contains("line 2: -1 is no tag's id"));
  CHECK_THAT(corners_refusal("1,0.5,1,1,2,3,4,5,6,7,8\n"), Contains("line 2: 0.5 is no tag's id"));
  CHECK_THAT(corners_refusal("1,1e9,1,1,2,3,4,5,6,7,8\n"), Contains("is no tag's id"));
  CHECK_THAT(corners_refusal("1,3,1,1,2,3,4,5,6,7,8\n" + good), Contains("line 3: its time is before"));
  CHECK_THAT(corners_refusal(good + "0,4,1,1,2,3,4,5,6,7,8\n" + good),
             Contains("line 4: tag 3 is there twice"));
  CHECK_THROWS_AS(read_corners("/nowhere/corners.csv"), Error);
}

TEST_CASE("Damaged tracks are refused with the line") {
  using Catch::Contains;
  CHECK_THAT(track_refusal(""), Contains("there are no poses in it"));
  CHECK_THAT(track_refusal("# only words\n"), Contains("there are no poses in it"));
  CHECK_THAT(track_refusal("0 1 2 3 0 0 0\n"), Contains("line 1: it is no pose"));
  CHECK_THAT(track_refusal("0 1 2 3 0 0 0 1 7\n"), Contains("line 1: it is no pose"));
  CHECK_THAT(track_refusal("0,1,2,3,0,0,0,1\n"), Contains("line 1: it is no pose"));
  CHECK_THAT(track_refusal("0 1 2 3 0 0 0-1\n"), Contains("line 1: it is no pose"));
  CHECK_THAT(track_refusal("0 1 nan 3 0 0 0 1\n"), Contains("line 1: it is no pose"));
  CHECK_THAT(track_refusal("0 1 2 3 0 0 0 0\n"), Contains("line 1: its quaternion"));
  CHECK_THAT(track_refusal("0 1 2 3 0 0 0 1\n0 1 2 3 0 0 0 1\n"), Contains("line 2: its time is not after"));
  CHECK_THAT(track_refusal("5 1 2 3 0 0 0 1\n\n4 1 2 3 0 0 0 1\n"),
             Contains("line 3: its time is not after"));
  CHECK_THAT(track_refusal("-1e10 1 2 3 0 0 0 1\n"), Contains("is no time"));
}
