// What contract.md lists under "Bad input: Text".
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "io/text/damaged_text.hpp"

namespace esi::test {
namespace {

ReadOptions tolerant() {
  ReadOptions options;
  options.max_unreadable = 1;
  return options;
}

}  // namespace

TEST_CASE("A bad line within a good recording is left out and counted") {
  struct Row {
    const char* line;
    Drop reason;
  };
  const Row row = GENERATE(values<Row>({
      {"nan 1 2 1", Drop::unreadable_line},
      {"inf 1 2 1", Drop::unreadable_line},
      {"0x10 1 2 1", Drop::unreadable_line},
      {"1,999 1 2 1", Drop::unreadable_line},
      {"1.999,1,2,1", Drop::unreadable_line},
      {"1.999 1 2", Drop::unreadable_line},
      {"1.999 1 2 1 1", Drop::unreadable_line},
      {"1.999 1 2 1 # why", Drop::unreadable_line},
      {"1.999", Drop::unreadable_line},
      {"1.999 nan 2 1", Drop::unreadable_line},
      {"1.999 1.5 2 1", Drop::unreadable_line},
      {"1.999 1 0x2 1", Drop::unreadable_line},
      {"1.999 1 99999999999999999999 1", Drop::unreadable_line},
      {"99999999999999999999 1 2 1", Drop::unreadable_line},
      {"4700000000000.0 1 2 1", Drop::unreadable_line},
      {"1.999 1 2 2", Drop::unreadable_line},
      {"1.999 1 2 -1", Drop::unreadable_line},
      {"1.999 1 2 11", Drop::unreadable_line},
      {"1.999 1 2 nan", Drop::unreadable_line},
      {"t x y p", Drop::unreadable_line},
      {"\x01\x02 \xff\xfe", Drop::unreadable_line},
      {"1.999 -1 2 1", Drop::outside_sensor},
      {"1.999 1 -2 1", Drop::outside_sensor},
      {"1.999 65536 2 1", Drop::outside_sensor},
      {"1.999 1 100000 1", Drop::outside_sensor},
  }));
  INFO(row.line);
  // Enough before it that the first lines, which decide on the dialect, do not hold it.
  const std::string before = good_lines(20000);
  const TextContent content = read_text(before + row.line + "\n20.000 65535 4 1\n20.001 6 65535 0\n");
  REQUIRE(content.events.size() == 20002);
  CHECK(content.events[20000] == Event{20000000, 65535, 4, true});
  CHECK(content.events[20001] == Event{20001000, 6, 65535, false});
  CHECK(content.losses.of(row.reason) == 1);
  CHECK(content.losses.dropped() == 1);

  // Among the first lines it does not mislead either (control characters there mean that it is no text).
  if (row.line[0] == '\x01') return;
  const TextContent early = read_text("0.000 9 9 1\n" + std::string(row.line) + "\n" + good_lines(1100));
  CHECK(early.events.size() == 1101);
  CHECK(early.losses.of(row.reason) == 1);
}

TEST_CASE("Unreadable lines are counted up to a share of all lines, judged at the end") {
  const std::string bad = "nan 1 2 1\n";
  CHECK(read_text(good_lines(999) + bad).losses.of(Drop::unreadable_line) == 1);
  CHECK(read_text(good_lines(500) + bad + bad + good_lines(1500)).losses.of(Drop::unreadable_line) == 2);
  CHECK_THAT(
      message_of(good_lines(998) + bad),
      Catch::EndsWith("1 of 999 lines cannot be read, the first at line 999 'nan 1 2 1': its time is not a "
                      "number in range; correct them, or raise --max-unreadable (now 0.001)"));
  ReadOptions strictest;
  strictest.max_unreadable = 0;
  CHECK_THAT(message_of(good_lines(5000) + bad, strictest), Catch::Contains("1 of 5001 lines"));
  CHECK(read_text(good_lines(10) + bad + bad, tolerant()).losses.of(Drop::unreadable_line) == 2);
  // Comments and blank lines are not lines of data.
  CHECK_THAT(message_of(good_lines(998) + bad + "#\n\n#\n\n"), Catch::Contains("1 of 999 lines"));
}

TEST_CASE("A last line that the end of the file cuts is told from one that only lacks its line end") {
  struct Row {
    const char* last_line;
    std::size_t events;
    std::int64_t cut;
  };
  const Row row = GENERATE(values<Row>({
      {"1.5 20 30 1", 101, 0},
      {"1.5 20 30 1 ", 101, 0},
      {"1.5 20 30 1\r", 101, 0},
      {"1.5 20 30 ", 100, 1},
      {"1.5 20 30", 100, 1},
      {"1.5 20", 100, 1},
      {"1.", 100, 1},
      {"1.5 20 30 -", 100, 1},
      {"# a comment", 100, 0},
      {"  ", 100, 0},
  }));
  INFO(row.last_line);
  const TextContent content = read_text(good_lines(100) + row.last_line);
  CHECK(content.events.size() == row.events);
  CHECK(content.losses.of(Drop::cut_line) == row.cut);
  CHECK(content.losses.dropped() == row.cut);
}

TEST_CASE("A last time that was cut and so reads as one long ago is no event") {
  const std::string lines = "1,2,0,1000000\n1,2,1,2000000\n";
  CHECK(read_text(lines + "1,2,0,300").losses.of(Drop::cut_line) == 1);
  CHECK(read_text(lines + "1,2,0,300").events.size() == 2);
  CHECK(read_text(lines + "1,2,0,3000000").events.size() == 3);
  CHECK(read_text(lines + "1,2,0,300\n").events.size() == 3);
}

TEST_CASE("A text without events is an error that says so") {
  const char* const text = GENERATE("\n", "\r\n\r\n", "# nothing\n", "# nothing", "t,x,y,p\n", "346 260\n",
                                    "346 260", "%geometry:346,260\n", "\xEF\xBB\xBF");
  INFO(text);
  CHECK_THAT(message_of(text), Catch::Contains("it holds no events"));
}

TEST_CASE("A text that cannot be read is an error that says what, where and what to do") {
  struct Row {
    std::string text;
    std::vector<const char*> parts;
    ReadOptions options = {};
  };
  ReadOptions columns;
  columns.columns = "xypt";
  ReadOptions polarity;
  polarity.polarity = PolarityCode::minus_plus_one;
  const Row row = GENERATE_COPY(values<Row>({
      {"", {"it is empty"}},
      {std::string("\x1f\x8b\x08\0\0\0\0\0", 8), {"gzip", "unpack"}},
      {std::string("\xff\xfe\x30\0.\0", 6), {"UTF-16", "convert"}},
      {std::string("0.1 1 2 1\n\0\0\0", 13), {"binary"}},
      // The first line
      {"0.1 1 2\n0.2 1 2 1\n", {"line 1 '0.1 1 2' has 3 columns, not 4", "one event a line"}},
      {"# a\n\n0.1 1 2 1 5\n", {"line 3 '0.1 1 2 1 5' has 5 columns, not 4"}},
      {"346 260\n7\n", {"line 2 '7' has 1 column, not 4"}},
      {"346 260\n346 260\n", {"line 2 '346 260' has 2 columns, not 4"}},
      {"t,x,y,p\n1,2,3\n", {"line 2 '1,2,3' has 3 columns, not 4"}},
      {"0,1 2,5 3 1\n", {"line 1", "decimal points, not commas"}},
      {"0.1 1,2 1\n", {"line 1", "has 2 columns"}},
      {"nan 1 2 1\ninf 1 2 0\n0x1 1 2 1\n",
       {"line 1 'nan 1 2 1' is not an event, nor are the lines after it"}},
      {"0.1 1 2 1\n", {"line 1", "column x is no whole number", "--columns"}, columns},
      {std::string(300000, 'x') + "\n0.1 1 2 1\n", {"line 1 'xxxxxx", "...' names no columns t, x, y, p"}},
      {"0.1 1 2 " + std::string(1000000, '1') + "\n", {"line 1 '0.1 1 2 1111", "not an event"}},
      // Names
      {"a,b,c,d\n1,2,3,4\n", {"line 1 'a,b,c,d' names no columns t, x, y, p", "--columns"}},
      {"t,x,y\n1,2,3\n", {"line 1 't,x,y' names no columns"}},
      {"t,x,x,p\n1,2,3,1\n", {"line 1 't,x,x,p' names no columns"}},
      {"<html>\n<body>\n", {"line 1 '<html>' names no columns"}},
      // Sizes
      {"0 260\n0.1 1 2 1\n", {"line 1 '0 260' gives no possible sensor size", "1 to 65536 px"}},
      {"346 99999999999\n0.1 1 2 1\n", {"line 1", "no possible sensor size"}},
      {"%geometry:-5,260\n1,2,1,5\n", {"line 1", "no possible sensor size"}},
      {"%geometry:346\n1,2,1,5\n", {"line 1 '%geometry:346' is not %geometry:WIDTH,HEIGHT"}},
      // Columns
      {"1 2 0.1 1\n5 2 0.2 0\n3 9 0.3 1\n", {"line 1", "perhaps --columns xytp"}},
      {"1,2,100000,1\n5,2,200000,0\n3,9,300000,1\n", {"line 1", "perhaps --columns xytp"}},
      {"0 1 2 0.1\n1 5 2 0.2\n1 3 9 0.3\n", {"line 1", "perhaps --columns pxyt"}},
      {"0.1 1 4 2\n0.2 0 2 9\n0.3 1 4 2\n", {"line 1", "perhaps --columns tpxy"}},
      {"9,5,1,1\n5,6,2,0\n7,7,1,1\n2,8,2,1\n8,9,0,0\n1,10,0,0\n", {"line 1", "perhaps --columns xtyp"}},
      {"0.1 1 2 255\n0.2 3 4 0\n", {"line 1", "polarity of 0/1, -1/1 or 1/2", "--columns"}},
      {"x,y,t,p\n1,2.5,100,1\n", {"line 2 '1,2.5,100,1'", "column y is no whole number", "--columns"}},
      {"t,x,y,p\n100,1,2,255\n200,3,4,0\n", {"line 2", "none of 0/1, -1/1, 1/2"}},
      {"0.1 1 2 5\n", {"line 1"}, polarity},
      {"0.1 1.5 2.5 1\n0.2 1.5 2.5 1\n", {"line 1", "whole coordinates"}},
  }));
  INFO(row.text.substr(0, 200));
  const std::string message = message_of(row.text, row.options);
  CHECK_THAT(message, Catch::Contains("events.txt: "));
  CHECK(message.size() < 400);
  CHECK(message.find('\n') == std::string::npos);
  for (const char* const part : row.parts) CHECK_THAT(message, Catch::Contains(part));
}

TEST_CASE("Whatever a text has been through, it gives events or an error") {
  const std::vector<std::string> texts = {
      "346 260\n" + good_lines(30),
      "# t x y p\n" + good_lines(30),
      "%geometry:346,260\n1,2,0,1000\n1,2,1,2000\n3,4,1,3000\n3,4,0,4000\n",
      "x,y,t_ms,p,label\r\n1,2,10.5,1,a\r\n1,2,11.5,-1,b\r\n3,4,12e3,1,c\r\n",
      "\xEF\xBB\xBF"
      "4294967290 1 2 1\n5 1 2 2\n100000 1 2 1\n",
  };
  static constexpr std::string_view kCharacters = "0123456789.,-+ \t\r\n#%eExna:\x80";
  std::mt19937 random(7);
  const auto pick = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int readable = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = texts[pick(texts.size())];
    for (std::size_t k = pick(6); k > 0; --k) {
      const std::size_t at = pick(text.size());
      const std::size_t length = std::min(pick(20), text.size() - at);
      switch (pick(4)) {
        case 0:
          text[at] = kCharacters[pick(kCharacters.size())];
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(pick(text.size()), text.substr(at, length));
          break;
        default:
          text.insert(at, 1, kCharacters[pick(kCharacters.size())]);
      }
      if (text.empty()) text = "\n";
    }
    INFO(text);
    try {
      const TextContent content = read_text(text, tolerant());
      const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
      REQUIRE(static_cast<std::int64_t>(content.events.size()) + content.losses.dropped() <= lines);
      readable += content.events.empty() ? 0 : 1;
    } catch (const Error& error) {
      REQUIRE_THAT(error.what(), Catch::Contains("events.txt: "));
    }
  }
  CHECK(readable > 1000);
}

}  // namespace esi::test
