// Readings of a text that are possible, but cannot be meant.
#include <catch2/catch.hpp>

#include "io/text/damaged_text.hpp"

namespace esi::test {

TEST_CASE("A unit that makes a recording implausibly long or short is an error that suggests another") {
  struct Row {
    const char* text;
    std::vector<const char*> parts;
  };
  const Row row = GENERATE(values<Row>({
      {"0.0 1 2 1\n950400.0 1 2 0\n", {"up to line 2 it lasts 11.0 days", "in seconds", "perhaps us"}},
      {"1000000.0 1 2 1\n2000000.0 1 2 0\n", {"11.6 days"}},
      {"0 1 2 1\n100000000000 1 2 0\n", {"1.2 days", "in microseconds", "--time-unit, perhaps ns"}},
      {"86400000001 1 2 0\n0 1 2 1\n", {"1.0 days"}},
      {"0 1 2 1\n999 1 2 0\n", {"lasts only 999 us", "in microseconds", "--time-unit (s, ms, us or ns)"}},
      {"0.1 1 2 1\n0.100005 1 2 0\n", {"lasts only 5 us", "in seconds"}},
      {"5 1 2 1\n1 1 2 0\n", {"lasts only 4 us"}},
  }));
  INFO(row.text);
  const std::string message = message_of(row.text);
  for (const char* const part : row.parts) CHECK_THAT(message, Catch::Contains(part));

  // Whoever gives the unit means it.
  for (const auto unit :
       {TimeUnit::seconds, TimeUnit::milliseconds, TimeUnit::microseconds, TimeUnit::nanoseconds}) {
    CHECK(read_text(row.text, in_unit(unit)).events.size() == 2);
  }
}

TEST_CASE("A recording of a day, of a millisecond, of one event or at one time is plausible") {
  const auto [text, events] = GENERATE(table<const char*, std::size_t>({
      {"0 1 2 1\n86400000000 1 2 0\n", 2},
      {"0 1 2 1\n1000 1 2 0\n", 2},
      {"0 1 2 1\n", 1},
      {"1744227144.732712 1 2 1", 1},
      {"77 1 2 1\n77 1 2 1\n77 9 2 0\n", 3},
      {"1744227144.732712 1 2 1\n1744227145.732712 1 2 1", 2},
      {"-0.5 1 2 1\n0.5 1 2 1", 2},
      {"t_us,x,y,p\n1,1,2,1\n2,1,2,0\n", 2},
  }));
  INFO(text);
  CHECK(read_text(text).events.size() == events);
}

TEST_CASE("Times that stop being whole microseconds are no silent change of unit") {
  std::string text;
  for (int i = 0; i < 50000; ++i) text += fmt::format("{} 1 2 1\n", 1000 * i);
  CHECK_THAT(message_of(text + good_lines(1000)),
             Catch::Contains("1000 of 51000 lines cannot be read, the first at line 50001 "
                             "'0.000 0 0 0': its time is not a whole number"));
}

TEST_CASE("Ones that turn out to be OFF are not silently taken as ON") {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += fmt::format("{} 1 2 1\n", 1000 * i);
  for (int i = 30000; i < 60000; ++i) text += fmt::format("{} 1 2 2\n", 1000 * i);
  CHECK_THAT(message_of(text), Catch::Contains("--polarity 1/2"));
}

}  // namespace esi::test
