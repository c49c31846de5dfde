// Every bad recording and config that contract.md lists, given to the tool. What a person gets is
// docs/bad_input.md, which comes from here: ESI_WRITE_DOCS=1 build/release/bin/test_bad_input writes it.
#include "bad_input/bad_input.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/run_tool.hpp"
#include "support/sample_text.hpp"
#include "support/shared_data.hpp"

using namespace esi::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

// What the address sanitizer holds back from reuse would count as ours.
[[maybe_unused]] const int kSmallQuarantine = setenv("ASAN_OPTIONS", "quarantine_size_mb=1", 0);

constexpr long kMostMemory_kib = 400 * 1024;  // the tool with its libraries takes 60 MB, ASan adds its own

fs::path page_path() { return source_dir() / "docs" / "bad_input.md"; }

std::int64_t counted_losses(const json& run) {
  std::int64_t sum = 0;
  for (const char* const kind : {"dropped", "damaged"}) {
    for (const auto& count : run["events"][kind]) sum += count.get<std::int64_t>();
  }
  return sum;
}

/// What is left on disk, which depends on the exit code alone.
void check_output(const fs::path& out, int exit_code) {
  if (exit_code == 2) CHECK_FALSE(fs::exists(out));
  if (exit_code == 1) CHECK_FALSE(fs::exists(out / "run.json"));
  if (exit_code != 0 && exit_code != 3) return;
  REQUIRE(fs::exists(out / "run.json"));
  const json run = json::parse(content_of(out / "run.json"));
  if (run["tool"] == "esi-eval") return;
  CHECK(run["events"]["used"] > 0);
  if (exit_code == 3) CHECK(counted_losses(run) > 0);
}

/// The message without what differs from run to run: folders.
std::string message_of(const std::string& err, const TempFolder& folder) {
  std::string text = err.substr(0, err.find('\n'));
  for (const fs::path& path : {folder.path(), source_dir()}) {
    const std::string prefix = path.string() + "/";
    for (std::size_t at = 0; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
  }
  return text;
}

std::string cell(std::string text) {
  text = std::regex_replace(text, std::regex("\\|"), "\\|");
  return std::regex_replace(text, std::regex("<"), "&lt;");
}

struct Command {
  std::string tool;
  std::vector<std::string> arguments;
};

/// The tool that reads such a file, with whatever else it needs.
Command command_for(const std::string& file_name, const std::string& file, const TempFolder& folder) {
  if (file_name == "ground_truth.json") {
    const auto recording = source_dir() / "data-samples/flight-start/events.aedat4";
    return {"esi-eval", {recording, "--method", "esi", "-g", file}};
  }
  if (file_name == "config.json") {
    return {"esi-recon", {folder.write("good.txt", sample_text(3000, 10)), "--config", file}};
  }
  return {"esi-recon", {file}};
}

/// One run of the tool; returns the table's line.
std::string run_case(const BadInput& input, const std::string& file_name) {
  const TempFolder folder;
  const std::string file = folder.write(file_name, input.bytes());
  const auto out = folder / "out";
  auto [tool, arguments] = command_for(file_name, file, folder);
  arguments.insert(arguments.end(), {"-o", out, "--quiet"});
  arguments.insert(arguments.end(), input.arguments.begin(), input.arguments.end());
  const auto result = run_tool(tool, arguments);
  CAPTURE(file_name, input.what, result.err);
  CHECK(result.exit_code == input.exit_code);
  CHECK_THAT(result.err, Contains(input.told));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == (input.told.empty() ? 0 : 1));
  CHECK(result.peak_memory_kib < kMostMemory_kib);
  check_output(out, input.exit_code);
  const std::string message = message_of(result.err, folder);
  return fmt::format("| {} | {} | {} |\n", cell(input.what), result.exit_code,
                     message.empty() ? "" : "`" + cell(message) + "`");
}

std::string table_of(const BadInputs& inputs) {
  std::string table =
      fmt::format("\n## {}\n\n| input | exit code | message |\n|---|---|---|\n", inputs.title);
  for (const BadInput& input : inputs.cases) table += run_case(input, inputs.file_name);
  return table;
}

/// The docs page says of these inputs what the tool does.
void check(const BadInputs& inputs) {
  CHECK(content_of(page_path()).find(table_of(inputs)) != std::string::npos);
}

}  // namespace

TEST_CASE("bad text gets its exit code and its one line, as the docs say") { check(bad_text()); }
TEST_CASE("bad HDF5 gets its exit code and its one line, as the docs say") { check(bad_hdf5()); }
TEST_CASE("bad AEDAT 2 gets its exit code and its one line, as the docs say") { check(bad_aedat2()); }
TEST_CASE("bad AEDAT 3 gets its exit code and its one line, as the docs say") { check(bad_aedat3()); }
TEST_CASE("bad AEDAT 4 gets its exit code and its one line, as the docs say") { check(bad_aedat4()); }
TEST_CASE("bad RAW and DAT get their exit codes and their one line, as the docs say") {
  check(bad_prophesee());
}
TEST_CASE("bad ROS bags get their exit codes and their one line, as the docs say") { check(bad_rosbags()); }
TEST_CASE("bad configs get their exit codes and their one line, as the docs say") { check(bad_configs()); }
TEST_CASE("bad ground truths get their exit codes and their one line, as the docs say") {
  check(bad_truths());
}

TEST_CASE("the page of bad inputs is written", "[.write]") {
  std::string page =
      "# Bad input\n\n"
      "What esi-recon makes of recordings and configs that are not as they should be, and esi-eval of "
      "ground\n"
      "truths. This page is written by test/bad_input, which runs the tool on every one of them (with "
      "`--size`\n"
      "where the format has no sensor size); exit codes are those of [contract.md](contract.md).\n";
  for (const BadInputs& inputs : {bad_text(), bad_hdf5(), bad_aedat2(), bad_aedat3(), bad_aedat4(),
                                  bad_prophesee(), bad_rosbags(), bad_configs(), bad_truths()}) {
    page += table_of(inputs);
  }
  std::ofstream(page_path()) << page;
}
