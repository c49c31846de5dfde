#include "esi/core/options.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

enum class Shape { round, square };

struct Sample {
  bool loud = false;
  double tau_s = 2.0;
  std::optional<double> end_s;
  std::int64_t count = 3;
  std::string size = "1x1";
  Shape shape = Shape::square;

  void declare(OptionTable& table) {
    table.toggle("loud", loud, "be loud");
    table.real("tau_s", tau_s, {0.5, 10.0}, "s", "support");
    table.optional_real("end", end_s, {0.0, 100.0}, "s", "end");
    table.integer("count", count, {1, 9}, "", "how many");
    table.text("size", size, "a size", [](const std::string& text) {
      if (text == "bad") throw usage_error("size 'bad' is not possible");
    });
    table.choice("shape", shape, {"round", "square"}, "a shape");
  }
};

}  // namespace

TEST_CASE("an option takes the same value from text and from JSON") {
  struct Row {
    const char* name;
    const char* text;
    const char* json;
  };
  const auto row =
      GENERATE(Row{"loud", "true", "true"}, Row{"tau_s", "0.75", "0.75"}, Row{"tau_s", "1e1", "10"},
               Row{"end", "5", "5.0"}, Row{"end", "none", "null"}, Row{"count", "9", "9"},
               Row{"size", "346x260", "\"346x260\""}, Row{"shape", "round", "\"round\""});
  Sample from_text;
  Sample from_json;
  table_of(from_text).at(row.name).set_text(row.text);
  table_of(from_json).at(row.name).set_json(nlohmann::json::parse(row.json));
  CAPTURE(row.name, row.text);
  CHECK(table_of(from_text).json() == table_of(from_json).json());
  const nlohmann::json expected = nlohmann::json::parse(row.json);
  CHECK(table_of(from_text).json()[row.name] == expected);
}

TEST_CASE("a table read back from its own JSON is the same") {
  Sample sample;
  OptionTable table = table_of(sample);
  table.set_assignment("tau_s=3.25");
  table.set_assignment("shape=round");
  table.set_assignment("end=7");
  Sample copy;
  OptionTable copied = table_of(copy);
  copied.set_json(nlohmann::json::parse(table.json().dump()));
  CHECK(copied.json() == table.json());
  CHECK(copy.tau_s == 3.25);
  CHECK(copy.shape == Shape::round);
  CHECK(copy.end_s == 7.0);
}

TEST_CASE("what lies outside an option's domain is refused with the domain, and changes nothing") {
  struct Row {
    const char* name;
    const char* text;
    const char* told;
  };
  const auto row = GENERATE(Row{"tau_s", "0.4", "0.5 to 10 s"}, Row{"tau_s", "nan", "0.5 to 10 s"},
                            Row{"tau_s", "2,5", "0.5 to 10 s"}, Row{"tau_s", "", "0.5 to 10 s"},
                            Row{"count", "10", "1 to 9"}, Row{"count", "2.5", "1 to 9"},
                            Row{"count", "99999999999999999999", "1 to 9"},
                            Row{"shape", "oval", "round | square"}, Row{"loud", "maybe", "true | false"},
                            Row{"end", "-1", "0 to 100 s"}, Row{"size", "bad", "size 'bad'"});
  Sample sample;
  OptionTable table = table_of(sample);
  const nlohmann::json before = table.json();
  CAPTURE(row.name, row.text);
  CHECK_THROWS_WITH(table.at(row.name).set_text(row.text), Contains(row.told));
  CHECK(table.json() == before);
}

TEST_CASE("JSON of the wrong type is refused") {
  Sample sample;
  OptionTable table = table_of(sample);
  const auto text = GENERATE(R"({"tau_s":"2"})", R"({"count":1.5})", R"({"count":18446744073709551615})",
                             R"({"loud":1})", R"({"shape":0})", R"({"size":7})", R"({"tau_s":null})", "[1]");
  CHECK_THROWS_AS(table.set_json(nlohmann::json::parse(text)), Error);
}

TEST_CASE("an unknown option's nearest name is suggested") {
  Sample sample;
  OptionTable table = table_of(sample);
  CHECK_THROWS_WITH(table.set_assignment("tau=1"), Contains("'tau_s'"));
  CHECK_THROWS_WITH(table.set_assignment("shpae=round"), Contains("'shape'"));
  CHECK_THROWS_WITH(table.set_assignment("tau_s"), Contains("key=value"));
}
