#include "esi/sweep/sweep_axis.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "esi/core/error.hpp"

using namespace esi;
using Catch::Matchers::Contains;
using Texts = std::vector<std::string>;

TEST_CASE("A list has its values, a range both ends, a log range equal ratios") {
  CHECK(parse_axis("tau_s=0.5,1,2").values == Texts{"0.5", "1", "2"});
  CHECK(parse_axis("clamp=0.4:1.2:0.2").values == Texts{"0.4", "0.6", "0.8", "1", "1.2"});
  CHECK(parse_axis("a=0:1:0.3").values == Texts{"0", "0.3", "0.6", "0.9"});
  CHECK(parse_axis("a=-1:1:1").values == Texts{"-1", "0", "1"});
  CHECK(parse_axis("a=2:2:1").values == Texts{"2"});
  CHECK(parse_axis("n=log:1:8:4").values == Texts{"1", "2", "4", "8"});
  CHECK(parse_axis("n=log:8:1:4").values == Texts{"8", "4", "2", "1"});
  CHECK(parse_axis("decay=none,power").values == Texts{"none", "power"});
  CHECK(parse_axis("n=log:1:8:4").is_logarithmic);
  CHECK_FALSE(parse_axis("n=1:8:1").is_logarithmic);
}

TEST_CASE("Values in JSON are those of a command line") {
  CHECK(parse_axis("a", nlohmann::json::parse("[0.5, 2, true, null, \"power\", 2.0]")).values ==
        Texts{"0.5", "2", "true", "none", "power", "2"});
  CHECK(parse_axis("a", nlohmann::json("1:3:1")).values == Texts{"1", "2", "3"});
  CHECK_THROWS_WITH(parse_axis("a", nlohmann::json::parse("[]")), Contains("grid a"));
  CHECK_THROWS_WITH(parse_axis("a", nlohmann::json::parse("[[1]]")), Contains("[1] is no value"));
}

TEST_CASE("What is no axis is refused with what is wrong") {
  CHECK_THROWS_WITH(parse_axis("tau_s"), Contains("OPTION=VALUES"));
  CHECK_THROWS_WITH(parse_axis("=1"), Contains("OPTION=VALUES"));
  CHECK_THROWS_WITH(parse_axis("a=1:2"), Contains("is no range"));
  CHECK_THROWS_WITH(parse_axis("a=1:2:x"), Contains("'x' is no number"));
  CHECK_THROWS_WITH(parse_axis("a=1:nan:1"), Contains("'nan' is no number"));
  CHECK_THROWS_WITH(parse_axis("a=2:1:1"), Contains("ascend"));
  CHECK_THROWS_WITH(parse_axis("a=1:2:0"), Contains("ascend"));
  CHECK_THROWS_WITH(parse_axis("a=0:1:1e-12"), Contains("1000000000001 values"));
  CHECK_THROWS_WITH(parse_axis("a=log:0:1:3"), Contains("not above 0"));
  CHECK_THROWS_WITH(parse_axis("a=log:1:2"), Contains("is no log range"));
  CHECK_THROWS_WITH(parse_axis("a=log:1:2:2.5"), Contains("whole number"));
  CHECK_THROWS_WITH(parse_axis("a=log:1:2:0"), Contains("whole number"));
}

namespace {

struct Options {
  double tau_s = 1.0;
  std::optional<double> limit;
  bool flag = false;

  void declare(OptionTable& table) {
    table.real("tau_s", tau_s, {0.5, 10.0}, "s", "");
    table.optional_real("limit", limit, {0.0, 1.0}, "", "");
    table.toggle("flag", flag, "");
  }
};

SweepAxis checked(const std::string& assignment) {
  Options options;
  const AskedAxis asked = parse_axis(assignment);
  VariableOption option(table_of(options).at(asked.option));
  return checked_axis(asked, option);
}

}  // namespace

TEST_CASE("An axis has its option's unit, and values as the option writes them") {
  const SweepAxis axis = checked("tau_s=1,2.50");
  CHECK(axis.unit == "s");
  CHECK(axis.values == Texts{"1.0", "2.5"});
  CHECK(axis.numbers == std::vector<double>{1.0, 2.5});
  CHECK(checked("flag=1,false").values == Texts{"true", "false"});
  CHECK(checked("flag=1,false").numbers.empty());
  CHECK(checked("limit=none,0.5").numbers.empty());
}

TEST_CASE("A value that the option doesn't take, or twice, is refused") {
  CHECK_THROWS_WITH(checked("tau_s=1,20"), Contains("0.5 to 10 s"));
  CHECK_THROWS_WITH(checked("tau_s=1,"), Contains("tau_s"));
  CHECK_THROWS_WITH(checked("tau_s=1,1.0"), Contains("1.0 is there twice"));
}
