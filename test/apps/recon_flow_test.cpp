// esi-flow by esi-recon: its frames on several threads, and the motion that it writes.
#include <catch2/catch.hpp>

#include "support/folder_digest.hpp"
#include "support/run_tool.hpp"
#include "support/sample_text.hpp"
#include "support/temp_folder.hpp"

using namespace esi::test;
namespace fs = std::filesystem;

TEST_CASE("the workers that encode take part in esi-flow, and make no difference to the bytes") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(20000, 10, 173, 131));
  const auto bytes_with = [&](const std::string& threads) {
    const auto out = folder / threads;
    const auto motion = folder / ("motion" + threads);
    const auto result =
        run_tool("esi-recon", {recording, "--size", "173x131", "--method", "esi-flow", "--fps", "130",
                               "--median", "--threads", threads, "--quiet", "--flow-out", motion, "-o", out});
    CHECK(result.exit_code == 0);
    return digest_of(out) + digest_of(motion);
  };
  const std::string expected = bytes_with("1");
  for (const char* const threads : {"2", "3", "7"}) CHECK(bytes_with(threads) == expected);
}

TEST_CASE("esi-flow writes the image's motion beside each frame") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(10000, 10));
  const std::vector<std::string> arguments = {recording,  "-o",       folder / "out", "--size",       "12x9",
                                              "--method", "esi-flow", "--flow-out",   folder / "flow"};
  const auto result = run_tool("esi-recon", arguments);
  CAPTURE(result.err);
  CHECK(result.exit_code == 0);
  std::size_t frames = 0, fields = 0;
  for (const auto& entry : fs::directory_iterator(folder / "out"))
    frames += entry.path().extension() == ".png";
  for (const auto& entry : fs::directory_iterator(folder / "flow")) {
    if (entry.path().extension() != ".flo") continue;
    ++fields;
    CHECK(fs::file_size(entry.path()) == 12 + 12 * 9 * 8);
  }
  CHECK(frames > 5);
  CHECK(fields == frames);
  CHECK(fs::exists(folder / "flow" / "run.json"));
  CHECK(run_tool("esi-recon", arguments).exit_code == 2);  // neither folder is empty now
}
