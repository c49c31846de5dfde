// The method `network` through the tool: where its model comes from, and what a person reads when it is no
// good.

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/run_tool.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

test::ToolResult run(const std::filesystem::path& output, const std::string& model,
                     const std::string& setting = "window=time") {
  const auto sample = test::source_dir() / "data-samples" / "flight-start/events.aedat4";
  return test::run_tool("esi-recon",
                        {"--method", "network", "--set", "model=" + model, "--set", setting, "--quiet",
                         "--duration", "0.05", sample.string(), "-o", output.string()});
}

std::string tiny_network() { return (test::source_dir() / "test" / "models" / "tiny_network.onnx").string(); }

void check_refused(const test::ToolResult& result, int exit_code, const std::string& part) {
  CHECK(result.exit_code == exit_code);
  CHECK_THAT(result.err, StartsWith("esi-recon: ") && Contains(part));
  CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("network: a model that is given makes frames, and no noise") {
  const test::TempFolder folder;
  const test::ToolResult result = run(folder / "out", tiny_network());
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  const auto run_json = nlohmann::json::parse(test::content_of(folder / "out" / "run.json"));
  CHECK(run_json["files"].size() == 1);
  CHECK(run_json["files"][tiny_network()].get<std::string>().size() == 8);
  CHECK(std::filesystem::exists(folder / "out" / "frame_0000000004.png"));
}

TEST_CASE("network: a model that is missing or no good is one line, and nothing is written") {
  const test::TempFolder folder;
  const auto text = folder.write("text.onnx", "hello");
  const auto cut = folder.write("cut.onnx", test::content_of(tiny_network()).substr(0, 3000));
  std::string foreign = test::content_of(tiny_network());
  foreign.replace(foreign.find("Sigmoid"), 7, "Sigmoie");  // a layer that OpenCV has never heard of, and logs
  const auto layer = folder.write("layer.onnx", foreign);
  check_refused(run(folder / "out", layer.string()), 1, "layer.onnx: OpenCV can't load it");
  // The voxel grid's shape (axis 2, its value 5) says 6 bins; the weights are made for 5.
  std::string six_bins = test::content_of(tiny_network());
  six_bins[six_bins.find("\x08\x05", six_bins.rfind("voxel")) + 1] = '\x06';
  const auto bins = folder.write("bins.onnx", six_bins);
  check_refused(run(folder / "out", bins.string()), 1, "bins.onnx: OpenCV can't");
  check_refused(run(folder / "out", ""), 2, "scripts/export_onnx");
  check_refused(run(folder / "out", (folder / "absent.onnx").string()), 1, "absent.onnx");
  check_refused(run(folder / "out", folder.path().string()), 1, folder.path().string());
  check_refused(run(folder / "out", text.string()), 1, "text.onnx: this is no ONNX model");
  check_refused(run(folder / "out", cut.string()), 1, "cut.onnx: this is no ONNX model");
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}
