#include "esi/io/text/numbers.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace esi::test {
namespace {

std::string scaled_text(std::string_view text, int shift) {
  const auto number = split_decimal(text);
  if (!number) return "no number";
  const auto result = scaled(*number, shift);
  if (!result) return "overflow";
  return std::to_string(result->value) + (result->is_exact ? "" : " rounded");
}

}  // namespace

TEST_CASE("A decimal number is scaled exactly and rounded half up") {
  struct Row {
    const char* text;
    int shift;
    const char* expected;
  };
  const Row row = GENERATE(values<Row>({
      {"0", 6, "0"},
      {"0.000001", 6, "1"},
      {"1", 6, "1000000"},
      {"13.582596999000002", 6, "13582597 rounded"},
      {"2.1957200009999998", 6, "2195720 rounded"},
      {"0.0000005", 6, "1 rounded"},
      {"0.00000049999999999999999999999999999", 6, "0 rounded"},
      {"0.0000015", 6, "2 rounded"},
      {"-0.0000005", 6, "0 rounded"},
      {"-0.00000050000000000001", 6, "-1 rounded"},
      {"-0.0000015", 6, "-1 rounded"},
      {"-2.5", 6, "-2500000"},
      {"+2.5", 6, "2500000"},
      {".5", 6, "500000"},
      {"5.", 6, "5000000"},
      {"1744227144.732712", 6, "1744227144732712"},
      {"1.744227144732712e9", 6, "1744227144732712"},
      {"1.6E+9", 0, "1600000000"},
      {"1600e-3", 0, "2 rounded"},
      {"1499", -3, "1 rounded"},
      {"1500", -3, "2 rounded"},
      {"-1500", -3, "-1 rounded"},
      {"4", -3, "0 rounded"},
      {"12.5", 3, "12500"},
      {"000000000000000000000000000012", 0, "12"},
      {"0e99999999999999999999", 6, "0"},
      {"1e-99999999999999999999", 6, "0 rounded"},
      {"1e99999999999999999999", -3, "overflow"},
      {"4611686018427387904", 0, "4611686018427387904"},
      {"-4611686018427387904", 0, "-4611686018427387904"},
      {"4611686018427387905", 0, "overflow"},
      {"9223372036854775808", 0, "overflow"},
      {"99999999999999999999999999999999", 0, "overflow"},
      {"4611686018428", 6, "overflow"},
      {"0.00000000000000000000000000000001e32", 0, "1"},
  }));
  INFO(row.text << " * 10^" << row.shift);
  CHECK(scaled_text(row.text, row.shift) == row.expected);
}

TEST_CASE("What is not a finite decimal number is refused") {
  const char* const text =
      GENERATE("", "-", "+", ".", "nan", "NaN", "inf", "-inf", "0x1f", "1,5", "1e", "1e+", "e5", "--1",
               "1.2.3", "1 2", "12a", "1_000", "\xD9\xA1", "1.5f", "+-1", "-.", ".e1");
  INFO(text);
  CHECK_FALSE(split_decimal(text));
  CHECK_FALSE(parse_whole(text));
}

TEST_CASE("A whole number may be written with a point or an exponent, but nothing may be lost") {
  CHECK(parse_whole("219") == 219);
  CHECK(parse_whole("+219") == 219);
  CHECK(parse_whole("-1") == -1);
  CHECK(parse_whole("219.000") == 219);
  CHECK(parse_whole("2.190000000000000000e+02") == 219);
  CHECK_FALSE(parse_whole("219.5"));
  CHECK_FALSE(parse_whole("2.1905e+02"));
  CHECK_FALSE(parse_whole("99999999999999999999"));
  CHECK_FALSE(parse_whole("9223372036854775807"));
}

}  // namespace esi::test
