// What the real esi-sim writes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "apps/sim_command.hpp"
#include "support/folder_digest.hpp"
#include "support/shared_data.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::size_t lines_in(const fs::path& file) {
  const std::string text = content_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

json info(const fs::path& recording) {
  const auto result = run_tool("esi-recon", {recording, "--info", "--json", "--size", "64x48"});
  CAPTURE(recording, result.err);
  REQUIRE(result.exit_code == 0);
  return json::parse(result.out);
}

}  // namespace

TEST_CASE("a simulation in every format is one recording, with its truth") {
  const TempFolder folder;
  const auto out = folder / "out";
  const auto result =
      simulate(out, "--write h5,aedat4,txt --clean-frames --clean-fps 20 --labels --preview --threads 2");
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK(names_in(out) == std::vector<std::string>{"calib.txt", "camera.tum", "clean", "corners.csv",
                                                  "events.aedat4", "events.h5", "events.txt", "exposures.csv",
                                                  "ground_truth.json", "images", "images.txt", "labels.u8",
                                                  "preview.mp4", "preview.mp4.timestamps.txt", "run.json",
                                                  "target.tum"});
  const json run = run_of(out);
  const auto events = run["events"]["count"].get<std::size_t>();
  CHECK(events > 1000);
  for (const char* const name : {"events.h5", "events.aedat4", "events.txt"}) {
    const json read = info(out / name);
    for (const char* const key : {"on", "sum_x", "sum_y", "crc32", "t_first_us", "duration_us"}) {
      CAPTURE(name, key);
      CHECK(read[key] == run["events"][key]);
    }
    CHECK(read["events"] == events);
    CHECK(read["frames"] == (std::string(name) == "events.h5" ? 0 : 4));
  }
  CHECK(run["intensity_frames"] == 4);
  CHECK(lines_in(out / "exposures.csv") == 5);
  CHECK_THAT(content_of(out / "exposures.csv"), Contains("1,0.050000000,0.070000000\n"));
  CHECK(fs::file_size(out / "labels.u8") == events);
  const std::string labels = content_of(out / "labels.u8");
  const json phase = run["phases"][0];
  CHECK(std::count(labels.begin(), labels.end(), 0) == phase["signal"]);
  CHECK(std::count(labels.begin(), labels.end(), 1) == phase["shot"]);
  CHECK(std::count(labels.begin(), labels.end(), 2) == phase["hot"]);
  CHECK(phase["rate_mev_s"].get<double>() == Approx(static_cast<double>(events) / 0.2e6));

  CHECK(lines_in(out / "corners.csv") == 1 + 2 * 21);  // two tags at 0, 10, ..., 200 ms
  CHECK(lines_in(out / "preview.mp4.timestamps.txt") == 6);
  CHECK(lines_in(out / "camera.tum") == 41);
  CHECK(lines_in(out / "target.tum") == 41);
  CHECK(lines_in(out / "clean" / "images.txt") == 5);
  CHECK(cv::imread((out / "clean" / "frame_0000000004.png").string(), cv::IMREAD_UNCHANGED).size() ==
        cv::Size(64, 48));
  const json truth = json::parse(content_of(out / "ground_truth.json"));
  CHECK(truth["phases"] == json::parse(R"([{"name": "rotation", "start_s": 0.0, "end_s": 0.2}])"));
  CHECK(truth["tags"]["size_m"] == json::parse(R"({"0": 0.36, "1": 0.1})"));
  CHECK(truth["camera"]["width"] == 64);
  CHECK(truth["corners"] == "corners.csv");
  CHECK(truth["clean_frames"] == "clean/images.txt");
}

TEST_CASE("where only HDF5 is written, the intensity frames are pictures beside it") {
  const TempFolder folder;
  const auto out = folder / "out";
  REQUIRE(simulate(out).exit_code == 0);
  CHECK(names_in(out) == std::vector<std::string>{"camera.tum", "corners.csv", "events.h5", "exposures.csv",
                                                  "frames", "ground_truth.json", "run.json", "target.tum"});
  CHECK(names_in(out / "frames").size() == 5);
  CHECK_THAT(content_of(out / "frames" / "images.txt"), Contains("0.060000000 frame_0000000001.png\n"));
}

TEST_CASE("the same seed gives the same bytes on any number of threads, another seed other noise") {
  const TempFolder folder;
  const std::string all = "--write h5,aedat4,txt --labels --clean-frames ";
  REQUIRE(simulate(folder / "one", all + "--threads 1").exit_code == 0);
  REQUIRE(simulate(folder / "two", all + "--threads 2").exit_code == 0);
  CHECK((digest_of(folder / "one") == digest_of(folder / "two")));
  json one = run_of(folder / "one"), two = run_of(folder / "two");
  one.erase("run");
  two.erase("run");
  CHECK(one == two);

  REQUIRE(simulate(folder / "other", all + "--seed 2").exit_code == 0);
  CHECK(run_of(folder / "other")["events"]["crc32"] != one["events"]["crc32"]);
  for (const char* const name : {"corners.csv", "target.tum", "camera.tum", "ground_truth.json"}) {
    CAPTURE(name);
    CHECK((content_of(folder / "other" / name) == content_of(folder / "one" / name)));
  }
  CHECK((digest_of(folder / "other" / "clean") == digest_of(folder / "one" / "clean")));
  CHECK_FALSE((digest_of(folder / "other" / "images") == digest_of(folder / "one" / "images")));
}

TEST_CASE("a simulation that ends early is the beginning of the whole, with its truth up to there") {
  const TempFolder folder;
  const auto whole = folder / "whole", start = folder / "start";
  const std::string flight =
      sim() + " --sensor 64x48 --duration 0.2 --exposure-ms 20 --frame-period-ms 50 --quiet --write txt -o ";
  REQUIRE(run_shell(flight + quoted(whole)).exit_code == 0);
  REQUIRE(run_shell(flight + quoted(start) + " --end 0.123 --threads 1").exit_code == 0);
  const std::string events = content_of(start / "events.txt");
  CHECK(events.size() > 1000);
  CHECK(content_of(whole / "events.txt").starts_with(events));
  const std::string next = content_of(whole / "events.txt").substr(events.size(), 8);
  CHECK(next >= "0.123000");
  CHECK(lines_in(start / "images.txt") == 3);  // exposed from 0, 0.05 and 0.1 s on
  CHECK(content_of(whole / "corners.csv").starts_with(content_of(start / "corners.csv")));
  const json phases = json::parse(content_of(start / "ground_truth.json"))["phases"];
  REQUIRE(phases.size() == 2);
  CHECK(phases[1]["end_s"] == 0.123);
  CHECK(run_of(start)["duration_us"] == 123000);
}

TEST_CASE("a printed simulation config reads back equal, and makes the same recording") {
  const TempFolder folder;
  const auto printed = run_shell(sim() + tiny() + " --set threshold=0.3 --print-config");
  REQUIRE(printed.exit_code == 0);
  const auto file = folder.write("config.json", printed.out);
  const auto again = run_tool("esi-sim", {"--config", file, "--print-config"});
  CHECK(again.out == printed.out);
  CHECK(json::parse(again.out)["threshold"] == 0.3);
  REQUIRE(simulate(folder / "a", "--threshold 0.3").exit_code == 0);
  REQUIRE(run_tool("esi-sim", {"--config", file, "--quiet", "-o", folder / "b"}).exit_code == 0);
  CHECK((digest_of(folder / "a") == digest_of(folder / "b")));
}

TEST_CASE("every preset loads, and scale shrinks its sensor") {
  for (const char* const name : {"flight-indoor", "flight-dim", "flight-dark"}) {
    const TempFolder folder;
    const auto config = source_dir() / "configs" / "sim" / (std::string(name) + ".json");
    const auto result = run_tool("esi-sim", {"--config", config, "--scale", "0.1", "--duration", "0.2",
                                             "--no-intensity-frames", "--quiet", "-o", folder / "out"});
    CAPTURE(name, result.err);
    REQUIRE(result.exit_code == 0);
    const json run = run_of(folder / "out");
    CHECK(run["width"] == 35);
    CHECK(run["height"] == 26);
    CHECK(run["phases"].size() == 3);
    CHECK(run["config"]["illuminance_lux"].get<double>() ==
          json::parse(content_of(config))["illuminance_lux"].get<double>());
    CHECK(json::parse(content_of(folder / "out" / "ground_truth.json"))["camera"]["fx"].get<double>() ==
          Approx(17.5 / std::tan(40.0 * 3.14159265358979 / 180.0)));
  }
}
