// esi-recon from recordings to files, as a user runs it.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support/folder_digest.hpp"
#include "support/run_tool.hpp"
#include "support/sample_text.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

TEST_CASE("a text recording becomes a complete folder of frames") {
  const TempFolder folder;
  const auto recording = folder.write("events.txt", sample_text(3500, 10));
  const auto out = folder / "out";
  const auto result = run_tool("esi-recon", {recording, "--size", "12x9", "-o", out});
  CHECK(result.exit_code == 0);
  CHECK(result.out.empty());
  CHECK_THAT(result.err, StartsWith("esi-recon: 3500 events, 4 frames in "));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);

  CHECK(names_in(out) == std::vector<std::string>{"frame_0000000000.png", "frame_0000000001.png",
                                                  "frame_0000000002.png", "frame_0000000003.png",
                                                  "frames.csv", "images.txt", "run.json", "timestamps.txt"});
  CHECK(content_of(out / "timestamps.txt") == "0.010000000\n0.020000000\n0.030000000\n0.040000000\n");
  CHECK_THAT(content_of(out / "images.txt"), StartsWith("0.010000000 frame_0000000000.png\n"));
  CHECK(content_of(out / "frames.csv") ==
        "index,t_us,events_since_previous\n0,10000,1000\n1,20000,1000\n2,30000,1000\n3,40000,500\n");
  const cv::Mat frame = cv::imread((out / "frame_0000000003.png").string(), cv::IMREAD_UNCHANGED);
  CHECK(frame.type() == CV_8UC1);
  CHECK(frame.size() == cv::Size(12, 9));

  const json run = json::parse(content_of(out / "run.json"));
  CHECK(run["frames"] == 4);
  CHECK(run["events"]["read"] == 3500);
  CHECK(run["events"]["used"] == 3500);
  CHECK(run["recording"]["format"] == "text");
  CHECK(run["config"]["method"] == "esi");
  CHECK(run["config"]["fps"] == 100.0);
  CHECK(run["run"]["threads"].is_number());
}

TEST_CASE("the recording's events end in frames by every rule") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(3500, 10));
  const std::string times = folder.write("times.txt", "# s\n0.005\n0.0301 name.png\n");
  struct Row {
    std::vector<std::string> arguments;
    std::string frames;
  };
  const auto row = GENERATE(Row{{"--fps", "30"}, "0,33334,3334\n1,66667,166\n"},
                            Row{{"--every-events", "2000"}, "0,19991,2000\n1,34991,1500\n"},
                            Row{{"--times", "times.txt"}, "0,5000,500\n1,30100,2510\n"},
                            Row{{"--start", "0.01", "--end", "0.025"}, "0,20000,1000\n1,30000,500\n"},
                            Row{{"--start", "0.02", "--duration", "0.01"}, "0,30000,1000\n"});
  const auto out = folder / "out";
  std::vector<std::string> arguments = {recording, "--size", "12x9", "-o", out, "--quiet"};
  arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
  std::replace(arguments.begin(), arguments.end(), std::string("times.txt"), times);
  const auto result = run_tool("esi-recon", arguments);
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK(content_of(out / "frames.csv") == "index,t_us,events_since_previous\n" + row.frames);
}

TEST_CASE("frames at the file's own packets end where the packets end") {
  const TempFolder folder;
  const auto out = folder / "out";
  const auto sample = source_dir() / "data-samples" / "flight-start" / "events.aedat4";  // packets of 10 ms
  const auto result = run_tool("esi-recon", {sample, "--packets", "-o", out, "--quiet"});
  CHECK(result.exit_code == 0);
  const json run = json::parse(content_of(out / "run.json"));
  CHECK(run["frames"] == 20);
  CHECK(run["intensity_frames"] == 2);
  const std::string csv = content_of(out / "frames.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 21);
  CHECK(csv.find(",0\n") == std::string::npos);  // every packet had events
}

TEST_CASE("threads, locale and the way in make no difference to the bytes") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(20000, 10));
  const auto bytes_of = [&](const std::string& command) {
    const auto out = folder / "out";
    fs::remove_all(out);
    const auto result = run_shell(command + " --size 12x9 --quiet -o " + quoted(out));
    CHECK(result.exit_code == 0);
    return digest_of(out);
  };
  const std::string recon = quoted(tool("esi-recon"));
  const std::string expected = bytes_of(recon + " " + quoted(recording) + " --threads 1");
  CHECK(bytes_of(recon + " " + quoted(recording) + " --threads 2") == expected);
  CHECK(bytes_of(recon + " " + quoted(recording) + " --threads 7") == expected);
  CHECK(bytes_of("LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 " + recon + " " + quoted(recording)) == expected);
  const std::string from_stdin = bytes_of("cat " + quoted(recording) + " | " + recon + " -");
  CHECK(from_stdin.size() == expected.size());
}

TEST_CASE("frames go down a pipe as YUV4MPEG2") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(3500, 10));
  const auto result = run_tool("esi-recon", {recording, "--size", "12x9", "-o", "-"});
  CHECK(result.exit_code == 0);
  const std::string header = "YUV4MPEG2 W12 H9 F100:1 Ip A1:1 Cmono\n";
  CHECK_THAT(result.out, StartsWith(header + "FRAME\n"));
  CHECK(result.out.size() == header.size() + 4 * std::size_t{6 + 12 * 9});

  const auto closed =
      run_shell(quoted(tool("esi-recon")) + " " + quoted(recording) +
                " --size 12x9 --fps 100000 -o - | head -c 10 >/dev/null; exit ${PIPESTATUS[0]}");
  CHECK(closed.exit_code == 141);
}

TEST_CASE("a video holds every frame") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(3500, 10));
  const std::string extension = GENERATE(".mkv", ".avi", ".mp4");
  const auto video = folder / ("out" + extension);
  const auto result = run_tool("esi-recon", {recording, "--size", "16x16", "-o", video});
  CAPTURE(result.err);
  CHECK(result.exit_code == 0);
  CHECK(fs::file_size(video) > 0);
  CHECK(json::parse(content_of(video.string() + ".run.json"))["frames"] == 4);
}

TEST_CASE("several recordings get a folder each, and one that fails does not stop the rest") {
  const TempFolder folder;
  fs::create_directory(folder / "in");
  folder.write("in/a.txt", sample_text(1500, 10));
  folder.write("in/b.txt", "this is no recording\n");
  folder.write("in/c.csv", "t,x,y,p\n0,1,1,1\n5000,2,2,0\n");
  folder.write("in/notes.md", "not a recording");
  const std::string jobs = GENERATE("1", "3");
  const auto out = folder / "out";
  const auto result = run_tool("esi-recon", {folder / "in", "--size", "12x9", "-o", out, "--jobs", jobs});
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK(fs::exists(out / "a" / "run.json"));
  CHECK_FALSE(fs::exists(out / "b"));
  CHECK(fs::exists(out / "c" / "run.json"));
  const std::string summary = content_of(out / "summary.csv");
  CHECK_THAT(summary, StartsWith("recording,output,exit_code,events,frames,dropped\n"));
  CHECK_THAT(summary, Contains("a.txt," + (out / "a").string() + ",0,1500,2,0\n"));
  CHECK_THAT(summary, Contains("b.txt," + (out / "b").string() + ",1,0,0,0\n"));
  CHECK_THAT(summary, Contains("c.csv," + (out / "c").string() + ",0,2,1,0\n"));
}

TEST_CASE("recordings of the same name get folders that tell them apart") {
  const TempFolder folder;
  fs::create_directory(folder / "day");
  fs::create_directory(folder / "night");
  const std::string day = folder.write("day/events.txt", sample_text(150, 10));
  const std::string night = folder.write("night/events.txt", sample_text(250, 10));
  const std::string other = folder.write("night/events.csv", "t,x,y,p\n0,1,1,1\n5000,2,2,0\n");
  const auto out = folder / "out";
  const auto result = run_tool("esi-recon", {day, night, other, "--size", "12x9", "-o", out, "--quiet"});
  CAPTURE(result.err);
  CHECK(result.exit_code == 0);
  CHECK(names_in(out) ==
        std::vector<std::string>{"day-events.txt", "events.csv", "night-events.txt", "summary.csv"});
  const auto twice = run_tool("esi-recon", {day, day, "--size", "12x9", "-o", folder / "twice"});
  CHECK(twice.exit_code == 2);
  CHECK_FALSE(fs::exists(folder / "twice"));
}

TEST_CASE("what was lost is said in one line, counted in run.json, and told by exit code 3") {
  const TempFolder folder;
  const std::string text = sample_text(3500, 10) + "0.035001 40 1 1\n0.0351 1 1 1\n0.03505 2 2 1\n";
  const std::string recording = folder.write("events.txt", text);
  const auto out = folder / "out";
  const auto result = run_tool("esi-recon", {recording, "--size", "12x9", "-o", out, "--quiet"});
  CHECK(result.exit_code == 3);
  CHECK(result.err == "esi-recon: " + recording + ": lost: 1 outside_sensor, 1 sorted_jitter\n");
  const json run = json::parse(content_of(out / "run.json"));
  CHECK(run["events"]["read"] == 3503);
  CHECK(run["events"]["used"] == 3502);
  CHECK(run["events"]["dropped"]["outside_sensor"] == 1);
  CHECK(run["events"]["damaged"]["sorted_jitter"] == 1);

  const auto strict =
      run_tool("esi-recon", {recording, "--size", "12x9", "-o", folder / "strict", "--strict"});
  CHECK(strict.exit_code == 1);
  CHECK_THAT(strict.err, Contains("--strict"));
  CHECK_FALSE(fs::exists(folder / "strict" / "run.json"));
}

TEST_CASE("a run that is interrupted keeps its frames and does not claim to be complete") {
  const TempFolder folder;
  const auto out = folder / "out";
  const std::string signal = GENERATE("INT", "TERM");
  // An endless recording through a pipe; the signal comes when frames are there.
  const auto result = run_shell("( i=0; while echo \"$i 1 1 1\"; do i=$((i+1000)); done 2>/dev/null ) | " +
                                quoted(tool("esi-recon")) + " - --size 4x4 --time-unit us --quiet -o " +
                                quoted(out) + " & tool=$!; while [ ! -e " +
                                quoted(out / "frame_0000000003.png") + " ]; do sleep 0.02; done; kill -" +
                                signal + " $(pgrep -P $$ -x esi-recon || echo $tool); wait $tool");
  CHECK(result.exit_code == (signal == "INT" ? 130 : 143));
  CHECK(fs::exists(out / "frame_0000000003.png"));
  CHECK(fs::exists(out / "timestamps.txt"));
  CHECK_FALSE(fs::exists(out / "run.json"));
}

TEST_CASE("a recording ten times longer takes the same memory") {
  const TempFolder folder;
  const std::string shorter = folder.write("short.txt", sample_text(200000, 10));
  const std::string longer = folder.write("long.txt", sample_text(2000000, 10));
  // What the address sanitizer holds back from reuse would count as ours.
  const std::string recon = "ASAN_OPTIONS=quarantine_size_mb=1 " + quoted(tool("esi-recon"));
  const auto peak_of = [&](const std::string& recording, const std::string& out) {
    const auto result = run_shell(recon + " " + quoted(recording) + " --size 12x9 --quiet --threads 2 -o " +
                                  quoted(folder / out));
    CHECK(result.exit_code == 0);
    return result.peak_memory_kib;
  };
  const long peak_short = peak_of(shorter, "short");
  const long peak_long = peak_of(longer, "long");
  CAPTURE(peak_short, peak_long);
  CHECK(peak_long < peak_short + 4096 + peak_short / 10);
}
