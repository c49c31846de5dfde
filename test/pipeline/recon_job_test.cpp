// Whole jobs, where the method and the recording must go together.

#include "esi/pipeline/recon_job.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>

#include "esi/core/error.hpp"
#include "support/sample_text.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

/// 100 ms of events on 12x9 px, with three pictures beside them where `with_frames`.
std::filesystem::path recording_in(const test::TempFolder& folder, bool with_frames) {
  const auto path = folder.write("events.txt", test::sample_text(1000, 100));
  if (!with_frames) return path;
  folder.write("images.txt", "0.01 a.png\n0.0305 b.png\n0.07 c.png\n");
  for (const char* name : {"a.png", "b.png", "c.png"}) {
    cv::imwrite((folder / name).string(), cv::Mat(9, 12, CV_8UC1, cv::Scalar(100)));
  }
  return path;
}

ReconReport run(const test::TempFolder& folder, const std::filesystem::path& recording,
                const std::string& method, bool at_frames) {
  ReconConfig config;
  config.read.size = "12x9";
  config.choose_method(method);
  config.frames.at_frames = at_frames;
  return run_job({recording, folder / "out", 1, "test"}, config);
}

}  // namespace

TEST_CASE(
    "a method that needs intensity frames refuses a recording without them before anything is written") {
  const test::TempFolder folder;
  const auto recording = recording_in(folder, false);
  const auto method = GENERATE("edi", "edi-propagated");
  try {
    run(folder, recording, method, false);
    FAIL("taken");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::usage);
    CHECK_THAT(error.what(), Contains("events.txt: method '" + std::string(method) +
                                      "' needs intensity frames, and this recording (") &&
                                 Contains("has none"));
  }
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("methods that can do without intensity frames take a recording without them") {
  const test::TempFolder folder;
  const auto recording = recording_in(folder, false);
  const auto method = GENERATE("esi", "highpass", "complementary", "accumulator");
  CHECK(run(folder, recording, method, false).result.frames == 10);
  CHECK_THROWS_WITH(run(folder, recording, method, true),
                    Contains("no intensity frames") && Contains("--fps instead of --at-frames"));
}

TEST_CASE("at intensity frames every method makes one frame each") {
  const test::TempFolder folder;
  const auto recording = recording_in(folder, true);
  const auto method = GENERATE("edi", "edi-propagated", "complementary", "esi");
  const ReconReport report = run(folder, recording, method, true);
  CHECK(report.result.frames == 3);
  CHECK(report.result.intensity_frames == 3);
}

TEST_CASE("intensity frames that all lie outside the part asked for are missed in words") {
  const test::TempFolder folder;
  const auto recording = recording_in(folder, true);
  ReconConfig config;
  config.read.size = "12x9";
  config.frames.start_s = 0.08;
  config.choose_method("edi");
  CHECK_THROWS_WITH(run_job({recording, folder / "out", 1, "test"}, config),
                    Contains("no intensity frames in the part") && Contains("method 'edi'"));
  config.choose_method("complementary");
  config.frames.at_frames = true;
  CHECK_THROWS_WITH(run_job({recording, folder / "out2", 1, "test"}, config), Contains("--at-frames"));
}
