// What esi-recon says and does when it is asked wrongly, and how it answers questions.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "support/run_tool.hpp"
#include "support/sample_text.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

TEST_CASE("wrong usage is exit code 2 and one line, and nothing is written") {
  struct Row {
    std::vector<std::string> arguments;
    std::string told;
  };
  const auto row = GENERATE(
      Row{{"--fps", "0"}, "fps"}, Row{{"--fps", "-1"}, "fps"}, Row{{"--fps", "nan"}, "fps"},
      Row{{"--fps", "1e9"}, "fps"}, Row{{"--fps"}, "--fps"}, Row{{"--start", "2", "--end", "1"}, "--end"},
      Row{{"--threads", "0"}, "--threads"}, Row{{"--threads", "-1"}, "--threads"},
      Row{{"--threads", "1000000"}, "--threads"}, Row{{"--jobs", "x"}, "--jobs"},
      Row{{"--fsp", "30"}, "did you mean --fps?"}, Row{{"--set", "tau=1"}, "'tau_s'"},
      Row{{"--set", "tau_s"}, "key=value"}, Row{{"--set", "tau_s=-1"}, "tau_s"},
      Row{{"--method", "eis"}, "did you mean"}, Row{{"--size", "346"}, "346x260"},
      Row{{"--packets"}, "--packets"}, Row{{"--packets", "--every-events", "5"}, "exclude each other"},
      Row{{"--roi", "10,0,5x5"}, "sensor"}, Row{{"--time-unit", "weeks"}, "s | ms | us | ns"},
      Row{{"--force", "--resume"}, "--resume"}, Row{{"--flow-out", "flow"}, "method 'esi' doesn't"},
      Row{{"--method", "esi-flow", "--flow-out", "flow", "--resume"}, "--flow-out"});
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(100, 1000));
  std::vector<std::string> arguments = {recording, "-o", folder / "out", "--size", "12x9"};
  if (row.arguments.front() == "--size") arguments.resize(3);
  arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
  const auto result = run_tool("esi-recon", arguments);
  CAPTURE(row.arguments, result.err);
  CHECK(result.exit_code == 2);
  CHECK(result.out.empty());
  CHECK_THAT(result.err, StartsWith("esi-recon: ") && Contains(row.told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a recording without sensor size is a clear question, never a guess") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(100, 1000));
  const auto result = run_tool("esi-recon", {recording, "-o", folder / "out"});
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err, Contains("--size") && Contains(recording));
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("what can't be read is exit code 1 and one line that names it") {
  const TempFolder folder;
  folder.write("empty.txt", "");
  folder.write("comments.txt", "# nothing\n# here\n");
  folder.write("zip.txt", "PK\x03\x04 more");
  fs::create_directory(folder / "folder");
  struct Row {
    std::string name;
    std::string told;
  };
  const auto row = GENERATE(Row{"missing.txt", "missing.txt"}, Row{"empty.txt", "empty"},
                            Row{"comments.txt", "no events"}, Row{"zip.txt", "zip"},
                            Row{"folder", "no recordings"}, Row{"../../../../../../dev/null", "dev"});
  const auto result = run_tool("esi-recon", {folder / row.name, "-o", folder / "out", "--size", "4x4"});
  CAPTURE(row.name, result.err);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, StartsWith("esi-recon: ") && Contains(row.told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "out" / "run.json"));
}

TEST_CASE("an output that is in the way is refused, replaced with --force, and never the recording itself") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(100, 1000));
  const auto out = folder / "out";
  const auto recon = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {recording, "-o", out, "--size", "12x9", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool("esi-recon", arguments);
  };
  CHECK(recon({}).exit_code == 0);
  const auto again = recon({});
  CHECK(again.exit_code == 2);
  CHECK_THAT(again.err, Contains("--force"));
  CHECK(recon({"--force", "--fps", "10"}).exit_code == 0);
  CHECK_FALSE(fs::exists(out / "frame_0000000001.png"));

  const auto onto_itself = run_tool("esi-recon", {recording, "-o", recording, "--size", "12x9", "--force"});
  CHECK(onto_itself.exit_code == 2);
  fs::create_symlink(recording, folder / "link.txt");
  const auto through_link =
      run_tool("esi-recon", {recording, "-o", folder / "link.txt", "--size", "12x9", "--force"});
  CHECK(through_link.exit_code == 2);
  CHECK(content_of(recording) == sample_text(100, 1000));
}

TEST_CASE("an absurd sensor is refused before memory is taken") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", sample_text(100, 1000));
  const auto result = run_tool("esi-recon", {recording, "-o", folder / "out", "--size", "65536x65536"});
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, Contains("GB"));
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("help and version go to standard output") {
  const auto help = run_tool("esi-recon", {"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
  for (const char* flag : {"--fps", "--size", "--time-zero", "--set", "--info", "--strict", "--force"}) {
    CHECK_THAT(help.out, Contains(flag));
  }
  const auto version = run_tool("esi-recon", {"--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, StartsWith("esi-recon "));
}

TEST_CASE("the printed config is a config, and prints itself") {
  const TempFolder folder;
  const auto first = run_tool(
      "esi-recon", {"--print-config", "--fps", "30", "--set", "tau_s=3.5", "--start", "1", "--strict"});
  REQUIRE(first.exit_code == 0);
  const std::string file = folder.write("config.json", first.out);
  const auto second = run_tool("esi-recon", {"--print-config", "--config", file});
  CHECK(second.exit_code == 0);
  CHECK(second.out == first.out);
  const json config = json::parse(first.out);
  CHECK(config["fps"] == 30.0);
  CHECK(config["strict"] == true);
  CHECK(config["set"]["tau_s"] == 3.5);
  const auto overridden =
      run_tool("esi-recon", {"--config", file, "--no-strict", "--fps=60", "--print-config"});
  CHECK(json::parse(overridden.out)["strict"] == false);
  CHECK(json::parse(overridden.out)["fps"] == 60.0);
}

TEST_CASE("methods and formats are listed") {
  const auto methods = run_tool("esi-recon", {"--list-methods"});
  CHECK_THAT(methods.out, Contains("esi") && Contains("Dong") && Contains("tau_s="));
  const auto formats = run_tool("esi-recon", {"--list-formats"});
  CHECK_THAT(formats.out, Contains("aedat4") && Contains("hdf5") && Contains("text"));
}

TEST_CASE("asked with --info --json it says what a recording holds, without a sensor size") {
  const TempFolder folder;
  const std::string recording = folder.write("events.txt", "0.5 3 4 1\n0.5 11 8 0\n1.75 2 1 1\n");
  const auto result = run_tool("esi-recon", {recording, "--info", "--json"});
  CHECK(result.exit_code == 0);
  const json info = json::parse(result.out);
  CHECK(info["format"] == "text");
  CHECK(info["width"].is_null());
  CHECK(info["max_x"] == 11);
  CHECK(info["max_y"] == 8);
  CHECK(info["events"] == 3);
  CHECK(info["on"] == 2);
  CHECK(info["t_first_us"] == 500000);
  CHECK(info["duration_us"] == 1250000);
  CHECK(info["sum_x"] == 16);
  CHECK(info["sum_y"] == 13);
  CHECK(info["frames"] == 0);
  // zlib.crc32(struct.pack('<qHHB', 0,3,4,1) + struct.pack('<qHHB', 0,11,8,0) + struct.pack('<qHHB',
  // 1250000,2,1,1))
  CHECK(info["crc32"] == "562e92ec");
  CHECK_THAT(run_tool("esi-recon", {recording, "--info"}).out, Contains("largest x, y") && Contains("11, 8"));
}

TEST_CASE("the man page and the completion know every option") {
  const auto man = run_tool("esi-recon", {"--generate-man"});
  CHECK(man.exit_code == 0);
  CHECK_THAT(man.out, StartsWith(".TH ") && Contains("\\-\\-every\\-events") && Contains("EXIT STATUS"));
  CHECK_THAT(man.out, Contains("\n.nh\n") && Contains("\\fB\\-\\-strict, \\-\\-no\\-strict\\fR\n") &&
                          !Contains("{false}"));
  CHECK_THAT(run_tool("esi-recon", {"--help"}).out,
             Contains("--strict, --no-strict") && !Contains("{false}"));
  const auto completion = run_tool("esi-recon", {"--generate-completion"});
  CHECK(completion.exit_code == 0);
  const auto used =
      run_shell("source /dev/stdin <<< " + quoted(completion.out) +
                "; COMP_WORDS=(esi-recon --every); COMP_CWORD=1; _esi_recon; echo ${COMPREPLY[@]}");
  CHECK_THAT(used.out, Contains("--every-events"));
}
