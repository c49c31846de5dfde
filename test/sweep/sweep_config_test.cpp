#include "esi/sweep/sweep_config.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"
#include "support/shared_data.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

SweepConfig config_with(const std::vector<std::string>& axes) {
  SweepConfig config;
  for (const std::string& axis : axes) config.add_axis(parse_axis(axis));
  return config;
}

SweepConfig config_from(const json& text) {
  SweepConfig config;
  config.set_json(text, "test", "folder");
  return config;
}

}  // namespace

TEST_CASE("Every combination of values is one cell, the last axis running fastest") {
  const SweepGrid grid = config_with({"tau_s=1,2", "n=1,2,3"}).grid();
  REQUIRE(grid.cells() == 6);
  CHECK(grid.text(0) == "tau_s=1.0 n=1.0");
  CHECK(grid.text(1) == "tau_s=1.0 n=2.0");
  CHECK(grid.text(5) == "tau_s=2.0 n=3.0");
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) CHECK(grid.cell(grid.position(cell)) == cell);
  CHECK(SweepConfig().grid().cells() == 1);
}

TEST_CASE("The order in which axes are given makes no difference") {
  CHECK(config_with({"n=1,2", "tau_s=1,2"}).json() == config_with({"tau_s=1,2", "n=1,2"}).json());
  CHECK(config_with({"n=5", "n=1,2"}).grid().cells() == 2);  // the last one of an option counts
}

TEST_CASE("A cell is the base with the cell's values") {
  SweepConfig config = config_with({"tau_s=1,2", "fps=50,200", "median=false,true"});
  config.base.set("n=3");
  const SweepGrid grid = config.grid();
  REQUIRE(grid.cells() == 8);
  const json cell = config.cell_config(grid, 5).json();
  CHECK(grid.text(5) == "tau_s=2.0 median=false fps=200.0");
  CHECK(cell["set"]["tau_s"] == 2.0);
  CHECK(cell["set"]["n"] == 3.0);
  CHECK(cell["fps"] == 200.0);
  CHECK(cell["median"] == false);
}

TEST_CASE("A cell's rate of frames counts, also where it is the default's") {
  SweepConfig config = config_with({"fps=100,25"});
  config.base.frames.fps = 50;
  const SweepGrid grid = config.grid();
  const EvalConfig eval = config.eval_config(grid, {0, 1});
  CHECK(eval.frames_of(eval.methods[0]).fps == 100);
  CHECK(eval.frames_of(eval.methods[1]).fps == 25);
}

TEST_CASE("clamp and c set both bounds and both contributions") {
  SweepConfig config = config_with({"clamp=1,3", "c=0.25,0.5"});
  const json cell = config.cell_config(config.grid(), 3).json()["set"];
  CHECK(cell["e_max"] == 3.0);
  CHECK(cell["e_min"] == -3.0);
  CHECK(cell["c_on"] == 0.5);
  CHECK(cell["c_off"] == 0.5);
  config.choose_method("highpass");
  CHECK_THROWS_WITH(config.grid(), Contains("grid clamp"));
}

TEST_CASE("A config that was printed is the same sweep when it is read") {
  SweepConfig config = config_with({"tau_s=log:0.5:8:3", "decay=none,power"});
  config.base.set("n=3");
  config.judging.stride = 4;
  config.search.search = SearchOptions::Search::halving;
  config.detector.quad_decimate = 2.0;
  const SweepConfig read = config_from(config.json());
  CHECK(read.json() == config.json());
  CHECK(read.grid().axes()[1].is_logarithmic);
}

TEST_CASE("A config written by hand may be short, its recordings lie beside it") {
  const SweepConfig config = config_from(json::parse(
      R"({"grid": {"n": [1, 2], "tau_s": "1:3:1"}, "stride": 2,
          "recordings": [{"recording": "a.h5", "ground_truth": "../b.json"}]})"));
  CHECK(config.grid().cells() == 6);
  CHECK(config.judging.stride == 2);
  REQUIRE(config.inputs.size() == 1);
  CHECK(config.inputs[0].path == "folder/a.h5");
  CHECK(config.inputs[0].truth == "b.json");
}

TEST_CASE("Every config for sweeps loads, and its grid has more than one cell") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(esi::test::source_dir() / "configs/sweep")) {
    SweepConfig config;
    config.load(entry.path());
    CHECK_NOTHROW(config.check());
    CHECK(config.grid().cells() > 1);
    for (const EvalInput& input : config.inputs) CHECK(std::filesystem::exists(input.path));
    ++count;
  }
  CHECK(count >= 2);
}

TEST_CASE("What is wrong in a sweep is said before any work") {
  CHECK_THROWS_WITH(config_with({"tua_s=1"}).grid(), Contains("did you mean 'tau_s'"));
  CHECK_THROWS_WITH(config_with({"start=1"}).grid(), Contains("no such option to sweep"));
  CHECK_THROWS_WITH(config_with({"n=1,99"}).grid(), Contains("1 to 8"));
  CHECK_THROWS_WITH(config_with({"tau_s=1:1000:0.1", "alpha_hz=0:999:0.1", "n=1:8:0.001"}).grid(),
                    Contains("cells, more than"));
  CHECK_THROWS_WITH(config_with({"e_max=1,2", "clamp=1,3"}).grid(),
                    Contains("e_max") && Contains("another axis"));
  const SweepConfig contradictory = config_with({"e_min=0,3", "e_max=1,2"});
  CHECK_THROWS_WITH(contradictory.check(), Contains("e_m"));
  int asked = 0;
  CHECK_NOTHROW(contradictory.check([&] { return ++asked < 2; }));  // of the two cells that are possible
  CHECK(asked == 2);
  SweepConfig timed = config_with({"fps=10,20"});
  CHECK_NOTHROW(timed.check());
  timed.base.frames.every_events = 1000;
  CHECK_THROWS_WITH(timed.check(), Contains("grid fps"));
  SweepConfig odd;
  odd.search.first_stride = 12;
  CHECK_THROWS_WITH(odd.check(), Contains("power of two"));
  CHECK_THROWS_WITH(config_from({{"grdi", 1}}), Contains("grdi"));
  CHECK_THROWS_WITH(config_from({{"grid", 1}}), Contains("grid"));
  CHECK_THROWS_WITH(config_from({{"recordings", {"a.h5"}}}), Contains("recordings"));
  CHECK_THROWS_WITH(config_from({{"quality", true}}), Contains("quality"));
}
