#include "esi/core/json_text.hpp"

#include <catch2/catch.hpp>

#include "esi/core/error.hpp"

using namespace esi;
using Catch::Matchers::Contains;

TEST_CASE("good JSON is parsed") {
  const auto json = parse_json(R"({"a": [1, {"b": null}], "c": {"a": 2}})", "x.json");
  CHECK(json["a"][1]["b"].is_null());
  CHECK(json["c"]["a"] == 2);
}

TEST_CASE("bad JSON is refused with its name and place") {
  struct Row {
    std::string text;
    const char* told;
  };
  const auto row =
      GENERATE(Row{"{\n  \"a\": 1,\n  \"b\": }\n}", "line 3, column 8"}, Row{"", "line 1, column 1"},
               Row{"{\"a\": 1} x", "line 1, column 10"}, Row{R"({"a": 1, "a": 2})", "\"a\" is there twice"},
               Row{R"({"b": {"a": 1, "c": 3, "a": 2}})", "\"a\" is there twice"},
               Row{"{\"a\": nan}", "line 1"}, Row{std::string(100000, '['), "nested deeper"},
               Row{R"({"a": "\ud800"})", "line 1"}, Row{"{\"a\": 1e999}", "too large"});
  CHECK_THROWS_WITH(parse_json(row.text, "x.json"), Contains("x.json: ") && Contains(row.told));
  CHECK_THROWS_AS(parse_json(row.text, "x.json"), Error);
}

TEST_CASE("the same key in different objects is no duplicate") {
  CHECK_NOTHROW(parse_json(R"([{"a": 1}, {"a": 2}, {"a": {"a": 3}}])", "x.json"));
}
