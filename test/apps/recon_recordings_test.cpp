// Real recordings, read by the tool: what independent parsers found in them, and frames that were looked at.
#include <fmt/format.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support/folder_digest.hpp"
#include "support/run_tool.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// zlib's CRC-32 of the picture's pixels, row by row.
std::string pixel_crc(const fs::path& picture) {
  const cv::Mat image = cv::imread(picture.string(), cv::IMREAD_UNCHANGED);
  return fmt::format("{:08x}", crc32_z(0, image.data, image.total()));
}

}  // namespace

TEST_CASE("every shared recording has the digest that independent parsers found") {
  const auto digests = shared_data("digests.json");
  if (!digests) return;
  const json recordings = json::parse(content_of(*digests));
  for (const auto& [name, expected] : recordings.items()) {
    if (name.ends_with(".mcap")) continue;  // not a format of ours
    const auto result = run_tool("esi-recon", {digests->parent_path() / name, "--info", "--json"});
    CAPTURE(name, result.err);
    REQUIRE(result.exit_code == 0);
    const json info = json::parse(result.out);
    for (const auto& [key, value] : expected.items()) {
      if (info[key].is_null() && (key == "width" || key == "height")) continue;  // not in this format
      CAPTURE(key);
      CHECK(info[key] == value);
    }
  }
}

TEST_CASE("a bag has the events that an independent parser found") {
  const auto bag = shared_data("ros/test_events_1.bag");
  if (!bag) return;
  const json info = json::parse(run_tool("esi-recon", {*bag, "--info", "--json"}).out);
  CHECK(info["crc32"] == "551f79e4");
  CHECK(info["events"] == 343474);
  CHECK(info["duration_us"] == 2078178);
  CHECK(info["width"] == 640);
  CHECK(info["height"] == 480);
}

TEST_CASE("every layout of the tag board gives the same frames") {
  const std::vector<std::string> layouts = {
      "rpg.txt",     "dsec_blosc.h5",       "dsec_gzip.h5",    "e2calib_eds_lzf.h5",
      "m3ed_lzf.h5", "mvsec.hdf5",          "monash_e2vid.h5", "metavision_plain.hdf5",
      "txyp_us.csv", "metavision_xypt.csv", "e2vid.zip"};
  const TempFolder folder;
  std::string expected;
  for (const std::string& layout : layouts) {
    const auto recording = shared_data("tagboard/tagboard." + layout);
    if (!recording) return;
    CAPTURE(layout);
    const auto out = folder / layout;
    const auto result = run_tool("esi-recon", {*recording, "--size", "346x260", "-o", out, "--fps", "100",
                                               "--time-zero", "first-event", "--quiet"});
    CHECK(result.exit_code == 0);
    CHECK(fs::exists(out / "frame_0000000099.png"));
    CHECK_FALSE(fs::exists(out / "frame_0000000100.png"));
    const std::string digest = digest_of(out);
    if (expected.empty()) expected = digest;
    CHECK((digest == expected));
  }
}

// Each of these frames was looked at: upright, not mirrored where that can be told, and what the recording's
// origin says it shows. Two of them (foam90 and redpob) show little but noise.
TEST_CASE("a frame of every recording is the one that was looked at") {
  struct Row {
    std::string recording, size, fps;
    int frame;
    std::string crc;
  };
  const std::vector<Row> rows = {
      {"aedat2/IMU_rotDisk.aedat", "", "20", 40, "c8ba3955"},
      {"aedat2/checkerboard_1.aedat", "", "100", 6, "b1595d5a"},
      {"aedat2/jaer_MovingDarkBox.aedat", "", "5", 120, "55048227"},
      {"aedat2/mibblez_foam90.aedat", "", "5", 20, "5fc4c54a"},
      {"aedat4/aestream_davis.aedat4", "", "50", 4, "b0f28784"},
      {"aedat4/cuke-emlb_demo-01.aedat4", "", "50", 20, "f17b6dba"},
      {"aedat4/redpob_dvSave-2024_06_13_16_16_25.aedat4", "", "5", 20, "06982781"},
      {"aedat4/tonic_sample.aedat4", "", "50", 20, "5b465cba"},
      {"dat/NCARS_obj_004397_td.dat", "54x61", "50", 3, "5cc0bef1"},
      {"raw_evt/expelliarmus_evt2_sample.raw", "", "100", 4, "ed7b787d"},
      {"raw_evt/expelliarmus_evt3_sample.raw", "", "1000", 7, "0303ff04"},
      {"ros/test_events_1.bag", "", "20", 30, "81bd8c80"},
      {"tagboard/tagboard.rpg.txt", "346x260", "100", 95, "5a08f773"},
      {"txt/slider_depth/events_chunk.txt", "240x180", "100", 15, "d36f685a"},
      {"txt/shapes_rotation/events.txt", "240x180", "100", 8, "2b4b86fa"},
      {"txt/boxes_rotation/events.txt", "240x180", "1000", 12, "954d856f"},
  };
  for (const Row& row : rows) {
    const auto recording = shared_data(row.recording);
    if (!recording) return;
    const TempFolder folder;
    std::vector<std::string> arguments = {*recording,    "--fps",   row.fps, "--time-zero",
                                          "first-event", "--quiet", "-o",    folder / "out"};
    if (!row.size.empty()) arguments.insert(arguments.end(), {"--size", row.size});
    const auto result = run_tool("esi-recon", arguments);
    CAPTURE(row.recording, result.err);
    CHECK(result.exit_code == 0);
    CHECK(pixel_crc(folder / "out" / fmt::format("frame_{:010}.png", row.frame)) == row.crc);
  }
}
