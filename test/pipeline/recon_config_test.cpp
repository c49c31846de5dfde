#include "esi/pipeline/recon_config.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;

TEST_CASE("a printed config reads back equal") {
  ReconConfig config;
  config.set("tau_s=3.5");
  config.frames.fps = 30;
  config.read.size = "346x260";
  config.frames.start_s = 1.25;
  ReconConfig copy;
  copy.set_json(nlohmann::json::parse(config.json().dump()), "printed");
  CHECK(copy.json() == config.json());
  CHECK(copy.json()["set"]["tau_s"] == 3.5);
  CHECK(copy.frames.start_s == 1.25);
}

TEST_CASE("a later config or setting overrides an earlier one, and the rest stays") {
  ReconConfig config;
  config.set_json({{"fps", 50.0}, {"set", {{"tau_s", 4.0}}}}, "a");
  config.set_json({{"set", {{"c_on", 0.25}}}}, "b");
  config.set("tau_s=5");
  CHECK(config.frames.fps == 50.0);
  CHECK(config.json()["set"]["tau_s"] == 5.0);
  CHECK(config.json()["set"]["c_on"] == 0.25);
}

TEST_CASE("wrong configs are refused with the file and the nearest name") {
  struct Row {
    const char* text;
    const char* told;
  };
  const auto row = GENERATE(Row{R"({"fsp": 30})", "'fps'"}, Row{R"({"set": {"tau": 1}})", "'tau_s'"},
                            Row{R"({"method": "eis"})", "esi"}, Row{R"({"method": 3})", "method"},
                            Row{R"([])", "JSON object"}, Row{R"({"set": 1})", "JSON object"},
                            Row{R"({"fps": "100"})", "fps"}, Row{R"({"fps": 0})", "fps"},
                            Row{"{\"fps\": 1,\n}", "line 2"});
  const test::TempFolder folder;
  const auto file = folder.write("bad.json", row.text);
  ReconConfig config;
  CHECK_THROWS_WITH(config.load(file), Contains("bad.json: ") && Contains(row.told));
}

TEST_CASE("rules for frames exclude each other") {
  FrameOptions frames;
  frames.every_events = 5;
  frames.packets = true;
  CHECK_THROWS_WITH(frames.check(), Contains("exclude each other"));
  FrameOptions backwards;
  backwards.start_s = 2.0;
  backwards.end_s = 2.0;
  CHECK_THROWS_WITH(backwards.check(), Contains("--start and --end"));
  FrameOptions both;
  both.end_s = 1.0;
  both.duration_s = 1.0;
  CHECK_THROWS_WITH(both.check(), Contains("--duration"));
}
