#include "esi/io/ground_truth.hpp"

#include <catch2/catch.hpp>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

TEST_CASE("everything of a ground truth is read") {
  const TempFolder folder;
  const auto path = folder.write("truth.json", R"({
    "phases": [{"name": "landing, \"last\"", "start_s": 40.5, "end_s": 62.0},
               {"name": "straight", "start_s": 0.0, "end_s": 40.5}],
    "tags": {"family": "tag36h11", "ids": [1, 0], "size_m": {"0": 0.36, "1": 0.10}},
    "camera": {"width": 346, "height": 260, "fx": 206.0, "fy": 207.0, "cx": 172.5, "cy": 129.5,
               "distortion": [0.1, -0.2]},
    "corners": "corners.csv", "target_poses": "target.tum", "clean_frames": "clean/images.txt"})");
  const GroundTruth truth = read_ground_truth(path);
  REQUIRE(truth.phases.size() == 2);
  CHECK(truth.phases[0].name == "straight");
  CHECK(truth.phases[0].interval == Interval{0, 40500000});
  CHECK(truth.phases[1].name == "landing, \"last\"");
  CHECK(truth.phases[1].interval == Interval{40500000, 62000000});
  CHECK(truth.tags->family == "tag36h11");
  CHECK(truth.tags->ids == std::vector<int>{1, 0});
  CHECK(truth.tags->size_m == std::map<int, double>{{0, 0.36}, {1, 0.10}});
  CHECK(truth.camera->width_px == 346);
  CHECK(truth.camera->fy == 207.0);
  CHECK(truth.camera->distortion == std::vector<double>{0.1, -0.2});
  CHECK(truth.corners == folder / "corners.csv");
  CHECK(truth.clean_frames == folder / "clean/images.txt");
  CHECK(truth.camera_poses.empty());
}

TEST_CASE("phases alone are a ground truth") {
  const GroundTruth truth =
      parse_ground_truth(R"({"phases": [{"name": "a", "start_s": -1, "end_s": 2}]})", "truth.json");
  CHECK(truth.phases.at(0).interval == Interval{-1000000, 2000000});
  CHECK_FALSE(truth.tags.has_value());
  CHECK_FALSE(truth.camera.has_value());
}

TEST_CASE("a bad ground truth is a usage error that says where") {
  struct Row {
    std::string text, told;
  };
  const std::string phases = R"({"phases": [{"name": "a", "start_s": 0, "end_s": 2}], )";
  const auto row = GENERATE_COPY(
      Row{"", "line 1"}, Row{"[]", "not a JSON object"}, Row{"{}", "phases is missing"},
      Row{R"({"phases": []})", "at least one phase"}, Row{R"({"phases": {}})", "at least one phase"},
      Row{R"({"phases": [7]})", "phases[0]: it is not a JSON object"},
      Row{R"({"phases": [{"name": "a", "start_s": 0}]})", "phases[0]: end_s is missing"},
      Row{R"({"phases": [{"name": "a", "start_s": 2, "end_s": 2}]})", "phases[0]: end_s (2) is not after"},
      Row{R"({"phases": [{"name": "a", "start_s": 2, "end_s": 1}]})", "phases[0]: end_s (1) is not after"},
      Row{R"({"phases": [{"name": "", "start_s": 0, "end_s": 1}]})", "name is empty"},
      Row{R"({"phases": [{"name": 3, "start_s": 0, "end_s": 1}]})", "name"},
      Row{R"({"phases": [{"name": "a", "start_s": "0", "end_s": 1}]})", "start_s"},
      Row{R"({"phases": [{"name": "a", "start_s": 0, "end_s": 1e300}]})", "end_s"},
      Row{R"({"phases": [{"name": "a", "start_s": NaN, "end_s": 1}]})", "line 1"},
      Row{R"({"phases": [{"name": "a", "start_s": 0, "end_s": 1, "stop_s": 2}]})", "stop_s"},
      Row{R"({"phases": [{"name": "a", "start_s": 1, "end_s": 3}, {"name": "b", "start_s": 0, "end_s": 2}]})",
          R"("b" and "a" overlap from 1.0)"},
      Row{R"({"phases": [{"name": "a", "start_s": 0, "end_s": 1}, {"name": "a", "start_s": 2, "end_s": 3}]})",
          R"(name "a" is there twice)"},
      Row{phases + R"("tag": 1})", "did you mean"}, Row{phases + R"("corners": 1})", "corners"},
      Row{phases + R"("tags": {"ids": [1]}})", "tags: family is missing"},
      Row{phases + R"("tags": {"family": 1, "ids": [1]}})", "tags: family"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": []}})", "at least one id"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": [1, 1]}})", "1 is there twice"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": [-1]}})", "ids"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": [0], "size_m": {"1": 0.2}}})", "none of the ids"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": [0], "size_m": {"0": 0}}})", "size_m: 0"},
      Row{phases + R"("tags": {"family": "tag36h11", "ids": [0], "sizes": {}}})", "there is no \"sizes\""},
      Row{phases + R"("camera": {"width": 346}})", "camera: height is missing"},
      Row{phases + R"("camera": {"width": 0, "height": 1, "fx": 1, "fy": 1, "cx": 1, "cy": 1}})", "width"},
      Row{phases + R"("camera": {"width": 1, "height": 1, "fx": 0, "fy": 1, "cx": 1, "cy": 1}})", "fx"},
      Row{phases +
              R"("camera": {"width": 1, "height": 1, "fx": 1, "fy": 1, "cx": 1, "cy": 1, "distortion": 2}})",
          "distortion"});
  CAPTURE(row.text);
  try {
    parse_ground_truth(row.text, "truth.json");
    FAIL("it was taken");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::usage);
    CHECK_THAT(error.what(), Contains("truth.json: ") && Contains(row.told));
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
  }
}

TEST_CASE("phases that have no part of the recording in them are refused, with the likely reason") {
  const auto truth = [](const std::string& start_s, const std::string& end_s) {
    return parse_ground_truth(
        R"({"phases": [{"name": "a", "start_s": )" + start_s + R"(, "end_s": )" + end_s + "}]}",
        "truth.json");
  };
  const Interval recording{0, 62000000};
  CHECK_NOTHROW(require_overlap(truth("61.999999", "70"), recording, true, "rec"));
  CHECK_THROWS_WITH(
      require_overlap(truth("62", "70"), recording, true, "rec"),
      Contains("rec: the phases lie from 62.000000000 s to 70.000000000 s") && Contains("--time-zero"));
  CHECK_THROWS_WITH(require_overlap(truth("30000", "62000"), recording, true, "rec"),
                    Contains("milliseconds"));
  // From 0 on, milliseconds do overlap.
  CHECK_THROWS_WITH(require_overlap(truth("0", "62000"), recording, true, "rec"), Contains("milliseconds"));
  CHECK_NOTHROW(require_overlap(truth("0", "6200"), recording, true, "rec"));
  CHECK_NOTHROW(require_overlap(truth("0", "62000"), recording, false, "rec"));  // the rest was cut off
  CHECK_THROWS_WITH(require_overlap(truth("-5", "0"), recording, true, "rec"), Contains("--time-zero"));
}
