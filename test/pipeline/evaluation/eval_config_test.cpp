#include "esi/pipeline/evaluation/eval_config.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "support/shared_data.hpp"
#include "support/temp_folder.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::string preset(const std::string& name) { return test::source_dir() / "configs/recon" / name; }

}  // namespace

TEST_CASE("a printed evaluation config reads back equal, and lists every option once") {
  EvalConfig config;
  config.add_method("accumulator");
  config.add_method(preset("edi.json"));
  config.set_json({{"fps", 50}, {"ids", "3,4"}, {"quad_decimate", 2}, {"own_angle_error", 1}}, "test");
  config.set_json({{"methods", {{{"label", "slow"}, {"method", "esi"}, {"set", {{"tau_s", 3}}}}}}}, "test");
  EvalConfig copy;
  copy.set_json(config.json(), "printed");
  CHECK(copy.json() == config.json());
  CHECK(copy.methods.size() == 3);
  CHECK(copy.methods[2].label == "slow");
  CHECK(copy.methods[2].config.json()["set"]["tau_s"] == 3);
  CHECK(copy.frames.fps == 50);
  CHECK(copy.judging.id_list() == std::vector<int>{3, 4});
  std::size_t options = 0;
  for (const auto& group : config.groups()) options += group.table.options().size();
  CHECK(options + 1 == config.json().size());  // and the methods
}

TEST_CASE("methods come under names of their own") {
  EvalConfig config;
  config.add_method("esi");
  config.add_method(preset("esi-power.json"));
  CHECK(config.methods[0].label == "esi");
  CHECK(config.methods[1].label == "esi-power");
  CHECK_THROWS_WITH(config.add_method(preset("esi.json")), Contains("method esi is given twice"));
  CHECK_THROWS_WITH(config.add_method("eis"), Contains("did you mean"));
  CHECK_THROWS_WITH(config.add_method("nowhere.json"), Contains("nowhere.json"));
}

TEST_CASE("what all methods share can't be said by one of them") {
  const test::TempFolder folder;
  EvalConfig config;
  const auto row = GENERATE(std::pair{R"({"method": "esi", "size": "9x9"})", "how the recording is read"},
                            std::pair{R"({"method": "esi", "roi": "0,0,9x9"})", "which part"},
                            std::pair{R"({"method": "esi", "start": 1})", "which part"});
  CHECK_THROWS_WITH(config.add_method(folder.write("own.json", row.first)),
                    Contains("method own") && Contains(row.second) && Contains("esi-eval itself"));
  CHECK(config.methods.empty());
}

TEST_CASE("a method keeps its own times of frames, another takes everybody's; all use the same part") {
  EvalConfig config;
  config.add_method(preset("edi.json"));
  config.add_method("esi");
  config.frames.fps = 50;
  config.frames.end_s = 2.0;
  const FrameOptions own = config.frames_of(config.methods[0]);
  CHECK(own.at_frames);
  CHECK(own.end_s == 2.0);
  const FrameOptions shared = config.frames_of(config.methods[1]);
  CHECK_FALSE(shared.at_frames);
  CHECK(shared.fps == 50);
  CHECK(shared.end_s == 2.0);
}

TEST_CASE("a bad evaluation config is told with its name") {
  EvalConfig config;
  const auto row = GENERATE(
      std::pair{R"({"stirde": 2})", "did you mean 'stride'?"}, std::pair{R"([])", "JSON object"},
      std::pair{R"({"methods": "esi"})", "list"}, std::pair{R"({"methods": [{"method": "esi"}]})", "label"},
      std::pair{R"({"methods": [7]})", "label"},
      std::pair{R"({"methods": [{"label": ""}]})", "label is empty"},
      std::pair{R"({"methods": [{"label": "a", "fsp": 2}]})", "did you mean 'fps'"},
      std::pair{R"({"methods": ["esi", "esi"]})", "given twice"}, std::pair{R"({"stride": 0})", "stride"},
      std::pair{R"({"ids": "1,,2"})", "ids"}, std::pair{R"({"ids": "1,1"})", "1 is there twice"},
      std::pair{R"({"ids": "-1"})", "ids"}, std::pair{R"({"ids": "1,"})", "ids"},
      std::pair{R"({"corrected_bits": 4})", "corrected_bits"}, std::pair{R"({"max_age": -1})", "max_age"});
  CAPTURE(row.first);
  CHECK_THROWS_WITH(config.set_json(json::parse(row.first), "bad.json"),
                    Contains("bad.json: ") && Contains(row.second));
}

TEST_CASE("options that exclude one another are refused, also a method's own") {
  EvalConfig config;
  config.frames.every_events = 1000;
  config.frames.at_frames = true;
  CHECK_THROWS_AS(config.check(), Error);
  config.frames = {};
  CHECK_NOTHROW(config.check());
  config.set_json(json::parse(R"({"methods": [{"label": "a", "packets": true, "at_frames": true}]})"),
                  "test");
  CHECK_THROWS_AS(config.check(), Error);
}
