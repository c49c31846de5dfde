// What is left when something outside goes wrong: disks, limits, signals, other runs.
#include <catch2/catch.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support/folder_digest.hpp"
#include "support/run_tool.hpp"
#include "support/sample_text.hpp"
#include "support/temp_folder.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

std::string recon() { return quoted(tool("esi-recon")); }

/// A recording of 1 s on a 12x9 sensor.
std::string one_second(const TempFolder& folder) {
  return folder.write("events.txt", sample_text(100000, 10));
}

/// Whole pictures, and nothing that claims to be complete. Returns how many. (Several threads write at a
/// time, so that one of the last may be missing between others.)
std::size_t check_whole(const fs::path& out) {
  CHECK_FALSE(fs::exists(out / "run.json"));
  std::size_t frames = 0;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() != ".png") continue;
    CAPTURE(entry.path());
    CHECK(cv::imread(entry.path().string(), cv::IMREAD_GRAYSCALE).size() == cv::Size(12, 9));
    ++frames;
  }
  return frames;
}

/// Runs a command in which `folder` is a disk of its own, mounted with `options`.
ToolResult run_on_disk(const fs::path& folder, const std::string& options, const std::string& command) {
  fs::create_directories(folder);
  const std::string script =
      "mount -t tmpfs -o " + options + " tmpfs " + quoted(folder) + " || exit 99\n" + command;
  return run_shell("unshare -rm bash -c " + quoted(script));
}

/// Whether this machine lets us mount; else says so for ctest.
bool can_mount(const TempFolder& folder) {
  if (run_on_disk(folder / "probe", "size=64k", "true").exit_code == 0) return true;
  std::cerr << "SKIPPED: no disk can be mounted here\n";
  return false;
}

}  // namespace

TEST_CASE("on a full disk the run fails with the reason, and what is there is whole") {
  const TempFolder folder;
  if (!can_mount(folder)) return;
  const std::string recording = one_second(folder);
  const auto kept = folder / "kept";
  const auto result = run_on_disk(folder / "disk", "size=200k",
                                  "cd " + quoted(folder / "disk") + "\n" + recon() + " " + quoted(recording) +
                                      " --size 12x9 --fps 1000 --quiet -o out\ncode=$?\ncp -r out " +
                                      quoted(kept) + "\nexit $code");
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, StartsWith("esi-recon: ") && Contains("No space left"));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK(check_whole(kept) > 20);
}

TEST_CASE("a video on a full disk never gets its name") {
  const TempFolder folder;
  if (!can_mount(folder)) return;
  const std::string recording = one_second(folder);
  const std::string extension = GENERATE(".mkv", ".avi", ".mp4");
  const auto result = run_on_disk(folder / "disk", "size=12k",
                                  "cd " + quoted(folder / "disk") + "\n" + recon() + " " + quoted(recording) +
                                      " --size 12x10 --fps 1000 --quiet -o out" + extension +
                                      "\ncode=$?\n[ ! -e out" + extension + " ] || exit 98\nexit $code");
  CAPTURE(extension, result.err);
  CHECK(result.exit_code == 1);
}

TEST_CASE("a folder that cannot be written is named with the reason") {
  const TempFolder folder;
  if (!can_mount(folder)) return;
  const std::string recording = one_second(folder);
  const auto result =
      run_on_disk(folder / "disk", "size=64k,ro",
                  recon() + " " + quoted(recording) + " --size 12x9 -o " + quoted(folder / "disk" / "out"));
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, Contains("disk/out") && Contains("Read-only"));
}

TEST_CASE("files that may not grow, and a full device, are failures with their reason") {
  const TempFolder folder;
  const std::string recording = one_second(folder);
  const auto limited = run_shell("ulimit -f 1; " + recon() + " " + quoted(recording) +
                                 " --size 12x9 --fps 1000 --quiet -o " + quoted(folder / "out"));
  CAPTURE(limited.err);
  CHECK(limited.exit_code == 1);
  CHECK_THAT(limited.err, Contains("too large") || Contains("File too large"));
  check_whole(folder / "out");

  const auto full = run_shell(recon() + " " + quoted(recording) + " --size 12x9 -o - >/dev/full");
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err, Contains("No space left"));
}

TEST_CASE("the folder of a killed run is refused without --resume") {
  const TempFolder folder;
  const std::string recording = one_second(folder);
  const std::string arguments = " --size 12x9 --fps 500 --quiet --threads 2";
  REQUIRE(run_shell(recon() + " " + quoted(recording) + arguments + " -o " + quoted(folder / "whole"))
              .exit_code == 0);
  const auto out = folder / "out";
  // The recording is held back after its first half, so that the run is surely within it.
  const auto killed = run_shell(
      "mkfifo " + quoted(folder / "pipe") + "; (head -c 1000000 " + quoted(recording) + "; sleep 60) >" +
      quoted(folder / "pipe") + " & feeder=$!; " + recon() + " - <" + quoted(folder / "pipe") + arguments +
      " -o " + quoted(out) + " & tool=$!; while [ ! -e " + quoted(out / "frame_0000000100.png") +
      " ]; do sleep 0.02; done; kill -9 $tool; wait $tool; code=$?; kill $feeder; exit $code");
  CHECK(killed.exit_code == 137);
  CHECK(check_whole(out) > 90);
  const std::string again = recon() + " " + quoted(recording) + arguments + " -o " + quoted(out);
  const auto refused = run_shell(again);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.err, Contains("--resume"));
}

TEST_CASE("a killed run of a file is resumed to the same bytes") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(400000, 10));
  const std::string arguments = " " + quoted(recording) + " --size 12x9 --fps 2000 --quiet --threads 2 -o ";
  const auto out = folder / "out";
  REQUIRE(run_shell(recon() + arguments + quoted(folder / "whole")).exit_code == 0);
  const auto killed =
      run_shell(recon() + arguments + quoted(out) + " & tool=$!; while [ ! -e " +
                quoted(out / "frame_0000000200.png") + " ]; do sleep 0.005; done; kill -9 $tool; wait $tool");
  CHECK(killed.exit_code == 137);
  CHECK(check_whole(out) > 90);
  const auto resumed = run_shell(recon() + arguments + quoted(out) + " --resume");
  CAPTURE(resumed.err);
  CHECK(resumed.exit_code == 0);
  CHECK((digest_of(out) == digest_of(folder / "whole")));
  const auto other = run_shell(recon() + arguments + quoted(out) + " --resume --fps 1000");
  CHECK(other.exit_code == 2);
}

TEST_CASE("of two runs into one folder the second is refused, and the first goes on") {
  const TempFolder folder;
  const std::string recording = one_second(folder);
  const auto out = folder / "out";
  const auto result = run_shell(
      "mkfifo " + quoted(folder / "pipe") + "; (head -c 1000000 " + quoted(recording) + "; while [ ! -e " +
      quoted(folder / "go") + " ]; do sleep 0.02; done; tail -c +1000001 " + quoted(recording) + ") >" +
      quoted(folder / "pipe") + " & " + recon() + " - <" + quoted(folder / "pipe") +
      " --size 12x9 --quiet -o " + quoted(out) + " & first=$!; while [ ! -e " +
      quoted(out / "frame_0000000005.png") + " ]; do sleep 0.02; done; for how in '' --force --resume; do " +
      recon() + " " + quoted(recording) + " --size 12x9 --quiet $how -o " + quoted(out) +
      "; echo $?; done; touch " + quoted(folder / "go") + "; wait $first; echo $?");
  CAPTURE(result.err);
  CHECK(result.out == "2\n1\n2\n0\n");  // not empty; in use; begun from another input
  CHECK_THAT(result.err, Contains("another run"));
  CHECK(json::parse(content_of(out / "run.json"))["frames"] == 100);
}

TEST_CASE("an output folder that vanishes is a failure, and does not come back") {
  const TempFolder folder;
  const auto out = folder / "out";
  const auto result =
      run_shell("( i=0; while echo \"$i 1 1 1\"; do i=$((i+1000)); done 2>/dev/null ) | " + recon() +
                " - --size 4x4 --time-unit us --quiet -o " + quoted(out) + " & tool=$!; while [ ! -e " +
                quoted(out / "frame_0000000003.png") + " ]; do sleep 0.02; done; mv " + quoted(out) + " " +
                quoted(folder / "gone") + "; wait $tool");
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK_FALSE(fs::exists(out / "run.json"));
  CHECK_FALSE(fs::exists(folder / "gone" / "run.json"));
}

TEST_CASE("a recording that is cut while it is read is used up to there") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(500000, 10));
  const auto out = folder / "out";
  // The reader of the frames waits, so that the tool waits in the middle of the recording.
  const auto result =
      run_shell(recon() + " " + quoted(recording) +
                " --size 12x9 --fps 10000 --quiet --threads 1 -o - | (head -c 1000 >/dev/null; "
                "truncate -s 1000000 " +
                quoted(recording) + "; cat >/dev/null); exit ${PIPESTATUS[0]}");
  CAPTURE(result.err);
  CHECK((result.exit_code == 3 || result.exit_code == 0));  // the cut may fall between two lines
  if (result.exit_code == 3) CHECK_THAT(result.err, Contains("cut_line"));
}

#ifndef __SANITIZE_ADDRESS__  // the sanitizers need file descriptors themselves, and a memory map of
                              // terabytes
TEST_CASE("a run with too few file descriptors works, or says so") {
  const TempFolder folder;
  const std::string recording = one_second(folder);
  const auto few = run_shell("ulimit -n 6; " + recon() + " " + quoted(recording) +
                             " --size 12x9 --quiet -o " + quoted(folder / "few"));
  CAPTURE(few.err);
  CHECK((few.exit_code == 0 || few.exit_code == 1));
  if (few.exit_code == 1) CHECK_THAT(few.err, StartsWith("esi-recon: ") && Contains("Too many open files"));
  CHECK(fs::exists(folder / "few" / "run.json") == (few.exit_code == 0));
}

TEST_CASE("a sensor that needs more memory than the process may have is refused before any is taken") {
  const TempFolder folder;
  const std::string recording = one_second(folder);
  const auto result = run_shell("ulimit -v 4000000; " + recon() + " " + quoted(recording) +
                                " --size 15000x15000 --quiet -o " + quoted(folder / "out"));
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, Contains("15000x15000 needs 7.2 GB of memory, and 4.1 GB are there"));
  CHECK_FALSE(fs::exists(folder / "out"));
}
#endif

TEST_CASE("a recording comes through any kind of standard input, or it is said why not") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(300, 100));
  const std::string rest = " - --size 12x9 --quiet -o ";
  const auto bytewise = run_shell("dd if=" + quoted(recording) + " bs=1 2>/dev/null | " + recon() + rest +
                                  quoted(folder / "bytewise"));
  CHECK(bytewise.exit_code == 0);
  const auto redirected =
      run_shell(recon() + rest + quoted(folder / "redirected") + " <" + quoted(recording));
  CHECK(redirected.exit_code == 0);
  CHECK(digest_of(folder / "bytewise") == digest_of(folder / "redirected"));
  const auto closed = run_shell(recon() + rest + quoted(folder / "closed") + " <&-");
  CHECK(closed.exit_code == 1);
  CHECK_THAT(closed.err, Contains("standard input: it is closed"));
  const auto nothing = run_shell(recon() + rest + quoted(folder / "nothing") + " </dev/null");
  CHECK(nothing.exit_code == 1);
  CHECK_THAT(nothing.err, Contains("standard input") && Contains("empty"));
}

TEST_CASE("paths may have blanks, letters of any language, and a leading dash") {
  const TempFolder folder;
  const std::string name = GENERATE("two words.txt", "Übung 例.txt", "-dash.txt", "it's \"quoted\".txt");
  folder.write(name, sample_text(300, 100));
  const auto result = run_shell("cd " + quoted(folder.path()) + " && " + recon() +
                                " --size 12x9 --quiet -o " + quoted("out " + name) + " -- " + quoted(name));
  CAPTURE(result.err);
  CHECK(result.exit_code == 0);
  CHECK(fs::exists(folder / ("out " + name) / "run.json"));
}
