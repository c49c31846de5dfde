#include "esi/io/writing/ground_truth_writer.hpp"

#include <clocale>
#include <limits>
#include <locale>

#include "io/writing/writer_fixtures.hpp"

using Catch::Contains;
using esi::GroundTruth;
using esi::test::content_of;
using esi::test::error_of;
using esi::test::names_in;
using esi::test::TempFolder;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

GroundTruth full_truth(const std::filesystem::path& folder) {
  GroundTruth truth;
  truth.phases = {{"straight, \"fast\" & \xc3\xa9\n", {-500001, 100000}}, {"turn", {100000, 62000000}}};
  truth.tags = {"tag36h11", {7, 0, 12}, {{0, 0.36}, {12, 0.1}}};
  truth.camera = {346, 260, 206.1, 1.0 / 3.0, 172.5, 129.5, {-0.1, 1e-7}};
  truth.corners = folder / "corners.csv";
  truth.target_poses = folder / "target.tum";
  truth.camera_poses = folder / ".." / folder.filename() / "camera.tum";
  truth.clean_frames = folder / "clean" / "images.txt";
  return truth;
}

}  // namespace

TEST_CASE("Ground truth reads back as it was written") {
  const TempFolder folder;
  const GroundTruth truth = full_truth(folder.path());
  esi::write_ground_truth(folder / "ground_truth.json", truth);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"ground_truth.json"});
  const GroundTruth found =
      esi::parse_ground_truth(content_of(folder / "ground_truth.json"), folder / "ground_truth.json");
  REQUIRE(found.phases.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(found.phases[i].name == truth.phases[i].name);
    CHECK(found.phases[i].interval == truth.phases[i].interval);
  }
  CHECK(found.tags->family == "tag36h11");
  CHECK(found.tags->ids == truth.tags->ids);
  CHECK(found.tags->size_m == truth.tags->size_m);
  CHECK(found.camera->width_px == 346);
  CHECK(found.camera->height_px == 260);
  CHECK(found.camera->fx == truth.camera->fx);
  CHECK(found.camera->fy == truth.camera->fy);
  CHECK(found.camera->cx == truth.camera->cx);
  CHECK(found.camera->cy == truth.camera->cy);
  CHECK(found.camera->distortion == truth.camera->distortion);
  CHECK(found.corners == truth.corners);
  CHECK(found.target_poses == truth.target_poses);
  CHECK(found.camera_poses == folder / "camera.tum");
  CHECK(found.clean_frames == truth.clean_frames);
}

TEST_CASE("Ground truth has the keys, order and numbers of the contract") {
  const TempFolder folder;
  GroundTruth truth;
  truth.phases = {{"a", {0, 30000000}}};
  esi::write_ground_truth(folder / "a.json", truth);
  CHECK(content_of(folder / "a.json") ==
        "{\n  \"phases\": [\n    {\n      \"name\": \"a\",\n      \"start_s\": 0.0,\n      \"end_s\": 30.0\n"
        "    }\n  ]\n}\n");
  truth.corners = folder / "sub" / "corners.csv";
  esi::write_ground_truth(folder / "a.json", truth);
  CHECK_THAT(content_of(folder / "a.json"), Contains("\"corners\": \"sub/corners.csv\""));
}

TEST_CASE("Ground truth that could not be read back is not written") {
  const TempFolder folder;
  const auto refused = [&](const auto& change) {
    GroundTruth truth = full_truth(folder.path());
    change(truth);
    const auto error = error_of([&] { esi::write_ground_truth(folder / "a.json", truth); });
    CHECK_THAT(error.what(), Contains("a.json: "));
    CHECK(names_in(folder.path()).empty());
  };
  refused([](GroundTruth& truth) { truth.phases.clear(); });
  refused([](GroundTruth& truth) { truth.phases[1].interval = {50000, 62000000}; });
  refused([](GroundTruth& truth) { truth.phases[0].name = "\xff"; });
  refused([](GroundTruth& truth) { truth.tags->ids = {1, 1}; });
  refused([](GroundTruth& truth) { truth.camera->fx = kNan; });
}

TEST_CASE("Corners are rows of csv, with numbers that read back as they were") {
  const TempFolder folder;
  esi::CornersWriter writer(folder / "corners.csv");
  writer.write({0, 3, true, {1, 2.5, -0.1, 1e-7, 5, 6, 7, 1.0 / 3.0}});
  writer.write({-1, 12, false, {}});
  writer.write({12340000, 0, true, {1, 2, 3, 4, 5, 6, 7, 8}});
  CHECK_FALSE(std::filesystem::exists(folder / "corners.csv"));
  writer.finish();
  CHECK(content_of(folder / "corners.csv") ==
        "t_s,id,visible,x1,y1,x2,y2,x3,y3,x4,y4\n"
        "0,3,1,1,2.5,-0.1,1e-07,5,6,7,0.3333333333333333\n"
        "-0.000001,12,0,0,0,0,0,0,0,0,0\n"
        "12.34,0,1,1,2,3,4,5,6,7,8\n");
}

TEST_CASE("Tracks are TUM lines") {
  const TempFolder folder;
  esi::TrackWriter writer(folder / "camera.tum");
  writer.write({-500000, {1, 2.5, -3}, {0, 0, 0, 1}});
  writer.write({10000000, {0.1, 0, 0}, {0.5, -0.5, 0.5, 0.5}});
  CHECK_THROWS_WITH(writer.write({10000000, {}, {}}), Contains("camera.tum: ") && Contains("10 s"));
  writer.finish();
  CHECK(content_of(folder / "camera.tum") == "-0.5 1 2.5 -3 0 0 0 1\n10 0.1 0 0 0.5 -0.5 0.5 0.5\n");
}

TEST_CASE("Numbers that aren't finite are refused") {
  const TempFolder folder;
  esi::CornersWriter corners(folder / "corners.csv");
  CHECK_THROWS_WITH(corners.write({0, 3, true, {1, kNan}}), Contains("corners.csv: nan"));
  esi::TrackWriter track(folder / "camera.tum");
  CHECK_THROWS_WITH(track.write({0, {HUGE_VAL, 0, 0}, {}}), Contains("camera.tum: inf"));
}

TEST_CASE("The locale does not change how truth and recordings are written") {
  /// As a German C++ program has it; the locale itself need not be installed.
  struct German : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const TempFolder folder;
  const esi::WriteOptions options{{1024, 768}, 1'234'567, "camera"};
  const auto write_all = [&](const std::string& run) {
    std::filesystem::create_directory(folder / run);
    GroundTruth truth = full_truth(folder.path());
    truth.corners = truth.target_poses = truth.camera_poses = truth.clean_frames = "";
    esi::write_ground_truth(folder / run / "a.json", truth);
    esi::TrackWriter track(folder / run / "camera.tum");
    track.write({1234500000, {1234.5, 0, 0}, {0, 0, 0, 1}});
    track.finish();
    for (const std::string name : {"a.txt", "a.aedat4", "a.h5"}) {
      esi::test::write_recording(folder / run / name, {{{1234567890, 1000, 700, true}}, {}}, options);
    }
  };
  write_all("C");
  const std::string old_c = std::setlocale(LC_ALL, nullptr);
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new German));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  write_all("de");
  std::setlocale(LC_ALL, old_c.c_str());
  std::locale::global(old);
  CHECK(content_of(folder / "C" / "camera.tum") == "1234.5 1234.5 0 0 0 0 0 1\n");
  for (const std::string& name : names_in(folder / "C")) {
    INFO(name);
    CHECK((content_of(folder / "C" / name) == content_of(folder / "de" / name)));
  }
}
