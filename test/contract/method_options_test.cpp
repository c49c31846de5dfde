// The table of methods, the options of each, and the configs for them.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "contract/method_player.hpp"
#include "esi/core/error.hpp"
#include "esi/pipeline/recon_config.hpp"

using namespace esi;
using namespace esi::test;
using Catch::Matchers::Contains;

TEST_CASE("methods have names of their own, a summary and a source") {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    CHECK(names.insert(method.name).second);
    CHECK_FALSE(method.summary.empty());
    CHECK_FALSE(method.source.empty());
    CHECK(&method_named(method.name) == &method);
  }
  CHECK(names.count("esi") == 1);
  CHECK_THROWS_WITH(method_named("esl"), Contains("'esl'") && Contains("'esi'"));
}

TEST_CASE("an option takes its bounds and refuses what lies beyond them") {
  const std::vector<Event> events = scene(7);
  for (const Method& method : methods()) {
    const auto defaults = configured(method);
    for (const Option& option : defaults->options().options()) {
      double low = 0.0;
      double high = 0.0;
      // "0.001 to 1000 s"
      std::stringstream domain(option.domain());
      if (std::string to; !(domain >> low >> to >> high) || to != "to") continue;
      INFO(method.name << " " << option.name());
      Option& own = defaults->options().at(option.name());
      for (const double wrong :
           {std::nextafter(low, -HUGE_VAL), std::nextafter(high, HUGE_VAL), std::floor(low) - 1.0,
            std::ceil(high) + 1.0, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        INFO(wrong);
        CHECK_THROWS_AS(own.set_text(fmt::format("{}", wrong)), Error);
        CHECK_THROWS_AS(own.set_json(wrong), Error);
      }
      for (const double bound : {low, high}) {
        const auto config = configured(method);
        config->options().at(option.name()).set_text(fmt::format("{}", bound));
        try {
          const auto frames = frames_of(*config, events);
          CHECK(frames.size() > 5);
        } catch (const Error& error) {  // it may not go together with the other defaults
          CHECK(error.kind() == Error::Kind::usage);
          CHECK_THAT(error.what(), Contains(option.name()));
        }
      }
    }
  }
}

TEST_CASE("an option is a bounded number, a choice or a switch, and refuses other texts") {
  for (const Method& method : methods()) {
    const auto config = configured(method);
    for (Option& option : config->options().options()) {
      if (option.name() == "model") continue;  // a file
      INFO(method.name << " " << option.name());
      CHECK_FALSE(option.domain().empty());
      const std::string before = option.text();
      for (const char* wrong : {"", "nonsense", "1e999", "-1e999", "1 2", "0x1p3"}) {
        CHECK_THROWS_AS(option.set_text(wrong), Error);
      }
      for (const nlohmann::json& wrong : {nlohmann::json::array(), nlohmann::json("nonsense")}) {
        CHECK_THROWS_AS(option.set_json(wrong), Error);
      }
      CHECK(option.text() == before);
    }
  }
}

TEST_CASE("every config for reconstruction loads and works, and a method's own has its defaults") {
  std::set<std::string> configs;
  for (const auto& file : std::filesystem::directory_iterator(source_dir() / "configs" / "recon")) {
    INFO(file.path());
    ReconConfig config;
    config.load(file.path());
    configs.insert(file.path().stem().string());
    if (file.path().stem() == config.method().name) {
      ReconConfig defaults;
      defaults.choose_method(std::string(config.method().name));
      CHECK(config.json()["set"] == defaults.json()["set"]);  // when frames are due is the config's own
    }
    const auto with_model = configured(config.method());
    if (Option* const model = with_model->options().find("model")) config.set("model=" + model->text());
    CHECK_FALSE(is_flat(frames_of(config.method_config(), scene(8)).back()));
  }
  for (const Method& method : methods()) CHECK(configs.count(std::string(method.name)) == 1);
}
